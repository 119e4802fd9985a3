// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/linear/bond_operator.h>
#include <perideal/operators/weights/family_weights.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/mpi.h>

#include "bodies.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

// The bond loops of one core beside what the core can do at most, measured in the same run, as JSON:
//
//   performance_bond_loops [nodes along an edge = 60] [seconds for each loop = 1]
//
// Loops are counted in undirected bonds of a cube of nodes, horizon 3.01 spacings. "scalar" is the linear
// operator of the ordinary model as one would write it first: a half list, plain loops, doubles.

using namespace perideal;

namespace
{
  double now()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  /// Seconds of one call: the median of calls for some seconds, at least five.
  double seconds_of(const std::function<void()> &call, const double duration)
  {
    call();
    std::vector<double> seconds;
    const double        begin = now();
    while (seconds.size() < 5 || now() - begin < duration)
      {
        const double start = now();
        call();
        seconds.push_back(now() - start);
      }
    std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
    return seconds[seconds.size() / 2];
  }

  /// Bytes a second that a loop over far more than the caches hold can read.
  double read_bandwidth(const double duration)
  {
    constexpr std::size_t              n = std::size_t(1) << 25;
    const dealii::AlignedVector<Lanes> numbers(n / 4, Lanes{1., 1., 1., 1.});
    volatile double                    keep = 0;
    return 8. * n /
           seconds_of(
             [&] {
               Lanes sum[8] = {};
               for (std::size_t k = 0; k < n / 4; k += 8)
                 for (unsigned int a = 0; a < 8; ++a)
                   sum[a] += numbers[k + a];
               for (const Lanes &part : sum)
                 keep = keep + sum_of_all(part);
             },
             duration);
  }

  /// Multiplications and additions a second, on lanes as the bond loops use them.
  double arithmetic(const double duration)
  {
    constexpr unsigned int n_sums = 10, n = 1000000;
    volatile double        keep = 1e-9;
    return 8. * n_sums * n /
           seconds_of(
             [&] {
               const double factor = keep;
               const Lanes  a = {factor, factor, factor, factor}, b = {0.5, 0.5, 0.5, 0.5};
               Lanes        sum[n_sums] = {};
               for (unsigned int k = 0; k < n; ++k)
                 for (Lanes &part : sum)
                   part = part * a + b;
               for (const Lanes &part : sum)
                 keep = keep + 1e-30 * sum_of_all(part);
             },
             duration);
  }

  /// The linear operator of the ordinary model on one rank as plain loops.
  struct ScalarLoop
  {
    using Weights = FamilyWeights<3, 1, false>;

    explicit ScalarLoop(const Weights &weights)
      : map(weights.map)
      , x(weights.families->position)
      , u(x.size())
      , f(x.size())
      , sum(x.size())
    {
      for (LocalIndex i = 0; i < weights.bonds.n_rows(); ++i)
        {
          for (BondIndex k = weights.bonds.row[i]; k < weights.bonds.row[i + 1]; ++k)
            if (weights.bonds.neighbour[k] != i)
              {
                const BondIndex at = weights.at(k);
                neighbour.push_back(weights.bonds.neighbour[k]);
                near.push_back(weights.sum_weight[0].near[at]);
                far.push_back(weights.sum_weight[0].far[at]);
                stiffness.push_back(weights.stiffness[at]);
              }
          row.push_back(neighbour.size());
        }
    }

    void vmult(NodalVector &force, const NodalVector &displacement)
    {
      const std::size_t n = x.size();
      for (std::size_t i = 0; i < n; ++i)
        {
          for (int d = 0; d < 3; ++d)
            {
              u[i][d] = displacement.local_element(3 * i + d);
              f[i][d] = 0.;
            }
          sum[i] = 0.;
        }
      for (std::size_t i = 0; i < n; ++i)
        {
          double own = 0.;
          for (std::size_t k = row[i]; k < row[i + 1]; ++k)
            {
              const LocalIndex j   = neighbour[k];
              const double     eps = extension(i, j);
              own += near[k] * eps;
              sum[j] += far[k] * eps;
            }
          sum[i] += own;
        }
      for (std::size_t i = 0; i < n; ++i)
        sum[i] = map.states(i, {{sum[i]}})[0];
      for (std::size_t i = 0; i < n; ++i)
        {
          double own[3] = {};
          for (std::size_t k = row[i]; k < row[i + 1]; ++k)
            {
              const LocalIndex j    = neighbour[k];
              const double     pull = stiffness[k] * extension(i, j) + near[k] * sum[i] + far[k] * sum[j];
              for (int d = 0; d < 3; ++d)
                {
                  const double along = pull * (x[j][d] - x[i][d]);
                  own[d] += along;
                  f[j][d] -= along;
                }
            }
          for (int d = 0; d < 3; ++d)
            f[i][d] += own[d];
        }
      for (std::size_t i = 0; i < n; ++i)
        for (int d = 0; d < 3; ++d)
          force.local_element(3 * i + d) = -f[i][d];
    }

    double extension(const std::size_t i, const std::size_t j) const
    {
      double result = 0.;
      for (int d = 0; d < 3; ++d)
        result += (x[j][d] - x[i][d]) * (u[j][d] - u[i][d]);
      return result;
    }

    FamilyMaps<1>                 map;
    std::vector<dealii::Point<3>> x, u, f;
    std::vector<double>           sum;
    std::vector<std::size_t>      row = {0};
    std::vector<LocalIndex>       neighbour;
    std::vector<double>           near, far, stiffness;
  };

  /// A cube of nodes, moved a little without pattern.
  struct Cube
  {
    explicit Cube(const unsigned int size)
      : mesh(test::make_box<3>({size, size, size}, {1., 1., 1.}, 0.))
      , body(*mesh)
    {
      displacement.reinit(body.families->make_partitioner(3));
      force = other = displacement;
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < 3; ++d)
          displacement.local_element(3 * i + d) = 1e-6 * test::scatter(body.nodes.position[i], d);
    }

    std::shared_ptr<BondWeights<3>>
    weigh(const std::string &model, const std::string &form, const bool share) const
    {
      ModelParameters parameters;
      parameters.model = model;
      parameters.form  = form;
      parameters.resolve(3);
      const ElasticConstants own = parameters.constants_of_model({1., 0.25, PlaneAssumption::solid});
      return weigh_bonds<3>(body.families,
                            *create_model<3>(parameters, 1.),
                            [&](const dealii::types::material_id) { return ElasticSolid<3>(own); },
                            {{}, false, share});
    }

    std::unique_ptr<Mesh<3>> mesh;
    test::Body<3>            body;
    NodalVector              displacement, force, other;
  };

  struct Variant
  {
    std::string  name, model, form;
    unsigned int n_sums;
    bool         own_force_weights;
  };

  /// Measures the linear and the nonlinear loop of each model.
  class Loops
  {
  public:
    Loops(Cube &cube, const double duration)
      : cube(cube)
      , duration(duration)
    {
    }

    void measure(const Variant &variant)
    {
      for (const bool share : {false, true})
        {
          const std::shared_ptr<const BondWeights<3>> weights =
            cube.weigh(variant.model, variant.form, share);
          const auto bonds = create_bond_operator<3>(weights);
          if (variant.name == "ordinary" && !share)
            measure_scalar(static_cast<const ScalarLoop::Weights &>(*weights), *bonds);
          const unsigned int per_pass = variant.n_sums == 0 ? 0 : share ? 4 : 16 * variant.n_sums;
          const unsigned int forces   = share ? 4 : 8 + 16 * variant.n_sums;
          add(
            variant.name + (share ? ", linear, equal families once" : ", linear"),
            [&] { bonds->vmult(cube.force, cube.displacement); },
            (variant.n_sums > 0 ? 4 + per_pass : 0) + 4 + forces,
            (variant.n_sums > 0 ? 11 + 4 * variant.n_sums : 0) + 22 + 4 * variant.n_sums);
          if (share)
            continue;
          const auto force = create_bond_force<3>(*weights);
          add(
            variant.name + ", large rotations",
            [&] { force->compute(cube.force, cube.displacement); },
            (variant.n_sums > 0 ? 12 + 8 * variant.n_sums : 0) + 16 + 8 * variant.n_sums,
            (variant.n_sums > 0 ? 11 + 4 * variant.n_sums : 0) + 21 + 4 * variant.n_sums);
        }
    }

    nlohmann::ordered_json rows;

  private:
    void measure_scalar(const ScalarLoop::Weights &weights, const BondOperator<3> &bonds)
    {
      ScalarLoop scalar(weights);
      add(
        "ordinary, linear, scalar", [&] { scalar.vmult(cube.other, cube.displacement); }, 52, 41);
      bonds.vmult(cube.force, cube.displacement);
      cube.other -= cube.force;
      AssertThrow(cube.other.linfty_norm() < 1e-12 * cube.force.linfty_norm(), dealii::ExcInternalError());
    }

    /// @param bytes that a bond takes from memory, nodes apart @param operations on a bond
    void add(const std::string           &name,
             const std::function<void()> &call,
             const unsigned int           bytes,
             const unsigned int           operations)
    {
      rows.push_back({{"loop", name},
                      {"bonds_per_second", cube.body.families->n_bonds() / seconds_of(call, duration)},
                      {"bytes", bytes},
                      {"operations", operations}});
    }

    Cube  &cube;
    double duration;
  };
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int                             size     = argc > 1 ? std::stoul(argv[1]) : 60;
  const double                                   duration = argc > 2 ? std::stod(argv[2]) : 1.;
  Cube                                           cube(size);
  Loops                                          loops(cube, duration);
  nlohmann::ordered_json                         result = {{"nodes", cube.body.nodes.n_global},
                                                           {"bonds", cube.body.families->n_bonds()},
                                                           {"read_bytes_per_second", read_bandwidth(duration)},
                                                           {"operations_per_second", arithmetic(duration)}};
  for (const Variant &variant : {Variant{"bond based", "bond based", "", 0, false},
                                 Variant{"ordinary", "ordinary", "", 1, false},
                                 Variant{"paper form", "extended ordinary", "paper", 1, true},
                                 Variant{"energy form", "extended ordinary", "energy", 2, false}})
    loops.measure(variant);
  result["loops"] = loops.rows;
  std::cout << result.dump(2) << std::endl;
}
