// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/gauss_operator.h>
#include <perideal/quadrature/bond_volume.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

namespace perideal
{
  namespace
  {
    /// Calls visit(n) with the number of points as a constant of the type std::integral_constant.
    template <int dim, typename Visit>
    auto visit_n_points(const unsigned int n_points, const Visit &visit)
    {
      using dealii::Utilities::pow;
      switch (n_points)
        {
        case 1:
          return visit(std::integral_constant<unsigned int, 1>());
        case pow(2u, dim):
          return visit(std::integral_constant<unsigned int, pow(2u, dim)>());
        case pow(3u, dim):
          return visit(std::integral_constant<unsigned int, pow(3u, dim)>());
        default:
          AssertThrow(n_points == pow(4u, dim), dealii::ExcNotImplemented());
          return visit(std::integral_constant<unsigned int, pow(4u, dim)>());
        }
    }
  } // namespace

  template <int dim>
  GaussOperator<dim>::GaussOperator(const std::shared_ptr<const Families<dim>>    &families,
                                    const std::shared_ptr<const GaussPoints<dim>> &points,
                                    const std::vector<double>                     &modulus,
                                    const Stiffening                              &stiffening)
    : families(families)
    , points(points)
    , far_factor(families->n_local(), 1.)
  {
    const bool stiffens = !stiffening.factor.empty();
    for (LocalIndex i = 0; i < families->n_local(); ++i)
      half_modulus.push_back(0.5 * modulus[i] *
                             (stiffens && !stiffening.of_neighbour ? stiffening.factor[i] : 1.));
    if (stiffens && stiffening.of_neighbour)
      far_factor = stiffening.factor;
    // Rows reach to the nodes of families and of supports.
    const auto       of_families = families->make_partitioner(dim);
    dealii::IndexSet ghosts      = of_families->ghost_indices();
    ghosts.add_indices(points->ghosts());
    this->partitioner = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
      of_families->locally_owned_range(), ghosts, families->communicator);
    points->initialize(at_points);
    this->reports.resize(families->n_owned());

    GlobalIndex n_empty =
      visit_n_points<dim>(points->n_points(), [&](const auto n) { return count_empty_families<n()>(); });
    n_empty = dealii::Utilities::MPI::sum(n_empty, families->communicator);
    if (n_empty > 0)
      throw InputError("the horizons of " + std::to_string(n_empty) + " nodes hold no part of a neighbour")
        .parameter("Nodes/Horizon factor")
        .hint("enlarge the factor");
  }

  template <int dim>
  template <unsigned int n>
  void GaussOperator<dim>::weigh(const LocalIndex i, const LocalIndex j, Bonds<n> &bonds) const
  {
    const double *volume = points->volume(j), *width = points->width(j);
    const double  near = far_factor[j] * half_modulus[i], far = far_factor[j] * half_modulus[j];
    const double  near_horizon = families->horizon[i], far_horizon = families->horizon[j];
    // A point in the node itself has no bond.
    const double smallest = 1e-20 * near_horizon * near_horizon;
    for (unsigned int g = 0; g < n; ++g)
      bonds.weight[g] = 0.;
    for (int d = 0; d < dim; ++d)
      {
        const double *x  = points->coordinate(j, d);
        const double  xd = families->position[i][d];
        for (unsigned int g = 0; g < n; ++g)
          {
            bonds.xi[d][g] = x[g] - xd;
            bonds.weight[g] += bonds.xi[d][g] * bonds.xi[d][g];
          }
      }
    for (unsigned int g = 0; g < n; ++g)
      {
        // linear_share() of both horizons, with one division.
        const double square = bonds.weight[g], length = std::sqrt(square), per_width = 1. / width[g];
        const double modulus = near * clamped_share((near_horizon - length) * per_width) +
                               far * clamped_share((far_horizon - length) * per_width);
        bonds.weight[g] = square > smallest ? modulus * volume[g] / (square * length) : 0.;
      }
  }

  template <int dim>
  template <unsigned int n>
  GlobalIndex GaussOperator<dim>::count_empty_families() const
  {
    GlobalIndex result = 0;
    Bonds<n>    bonds;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        // The first cell mostly tells.
        double sum = 0;
        visit_cells(*families, i, [&](const LocalIndex j) {
          if (sum > 0)
            return;
          weigh(i, j, bonds);
          for (const double weight : bonds.weight)
            sum += weight;
        });
        result += sum > 0 ? 0 : 1;
      }
    return result;
  }

  template <int dim>
  template <unsigned int n>
  void GaussOperator<dim>::sum_forces(NodalVector &force, const NodalVector &displacement) const
  {
    // Sums of four points at once; their order is fixed, so that sums are the same on any processor.
    constexpr unsigned int n_sums = n % 4 == 0 ? 4 : 1;
    Bonds<n>               bonds;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        double u[dim], sums[dim][n_sums] = {};
        for (int d = 0; d < dim; ++d)
          u[d] = displacement.local_element(dim * i + d);
        visit_cells(*families, i, [&](const LocalIndex j) {
          weigh(i, j, bonds);
          const double *v = at_points.begin() + std::size_t(dim) * j * n;
          for (unsigned int g = 0; g < n; g += n_sums)
            for (unsigned int s = 0; s < n_sums; ++s)
              {
                double along = 0;
                for (int d = 0; d < dim; ++d)
                  along += bonds.xi[d][g + s] * (v[d * n + g + s] - u[d]);
                along *= bonds.weight[g + s];
                for (int d = 0; d < dim; ++d)
                  sums[d][s] += along * bonds.xi[d][g + s];
              }
        });
        for (int d = 0; d < dim; ++d)
          force.local_element(dim * i + d) =
            -families->volume[i] * std::accumulate(sums[d], sums[d] + n_sums, 0.);
      }
  }

  template <int dim>
  void GaussOperator<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    points->interpolate(displacement, at_points);
    visit_n_points<dim>(points->n_points(), [&](const auto n) { sum_forces<n()>(force, displacement); });
    at_points.zero_out_ghost_values();
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> GaussOperator<dim>::jacobi_blocks() const
  {
    // Points are looked at where they are owned, for there their supports are known; a node of another rank
    // gets its part from there.
    constexpr unsigned int entries = dim * dim;
    NodalVector            blocks(families->make_partitioner(entries));
    visit_n_points<dim>(points->n_points(), [&](const auto n) { sum_blocks<n()>(blocks); });
    blocks.compress(dealii::VectorOperation::add);
    std::vector<dealii::Tensor<2, dim>> result(families->n_owned());
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          result[i][a][b] = blocks.local_element(entries * i + dim * a + b);
    return result;
  }

  template <int dim>
  template <unsigned int n>
  void GaussOperator<dim>::sum_blocks(NodalVector &blocks) const
  {
    constexpr unsigned int entries = dim * dim;
    Bonds<n>               bonds;
    for (LocalIndex j = 0; j < families->n_owned(); ++j)
      {
        const auto support = points->support(j);
        visit_cells(*families, j, [&](const LocalIndex i) {
          weigh(i, j, bonds);
          const auto    at  = std::find(support.begin(), support.end(), families->global_number(i));
          const double *phi = at == support.end() ? nullptr : points->weights(j) + (at - support.begin()) * n;
          for (unsigned int g = 0; g < n; ++g)
            {
              const double weight = families->volume[i] * bonds.weight[g] * (phi ? 1. - phi[g] : 1.);
              for (int a = 0; a < dim; ++a)
                for (int b = 0; b < dim; ++b)
                  blocks.local_element(entries * i + dim * a + b) += weight * bonds.xi[a][g] * bonds.xi[b][g];
            }
        });
      }
  }

  template <int dim>
  void GaussOperator<dim>::assemble(const typename BondOperator<dim>::AddBlock &add) const
  {
    visit_n_points<dim>(points->n_points(), [&](const auto n) { assemble_cells<n()>(add); });
  }

  template <int dim>
  template <unsigned int n>
  void GaussOperator<dim>::assemble_cells(const typename BondOperator<dim>::AddBlock &add) const
  {
    Bonds<n>                 bonds;
    std::vector<GlobalIndex> nodes, unknowns;
    std::vector<double>      values;
    for (LocalIndex j = 0; j < families->n_owned(); ++j)
      {
        // What the points of this cell do: rows of all nodes with a bond to it, columns of its support too.
        nodes = points->support(j);
        visit_cells(*families, j, [&](const LocalIndex i) { nodes.push_back(families->global_number(i)); });
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        const auto place = [&](const GlobalIndex number) {
          return dim * (std::lower_bound(nodes.begin(), nodes.end(), number) - nodes.begin());
        };
        const std::size_t size = dim * nodes.size();
        unknowns.clear();
        for (const GlobalIndex number : nodes)
          for (int d = 0; d < dim; ++d)
            unknowns.push_back(dim * number + d);
        values.assign(size * size, 0.);
        const auto support = points->support(j);
        visit_cells(*families, j, [&](const LocalIndex i) {
          weigh(i, j, bonds);
          const std::size_t row = place(families->global_number(i));
          const auto        put = [&](const std::size_t column, const auto &factor) {
            for (int a = 0; a < dim; ++a)
              for (int b = 0; b < dim; ++b)
                for (unsigned int g = 0; g < n; ++g)
                  values[(row + a) * size + column + b] +=
                    factor(g) * families->volume[i] * bonds.weight[g] * bonds.xi[a][g] * bonds.xi[b][g];
          };
          put(row, [](const unsigned int) { return 1.; });
          for (std::size_t k = 0; k < support.size(); ++k)
            put(place(support[k]), [&](const unsigned int g) { return -points->weights(j)[k * n + g]; });
        });
        add(unknowns, values);
      }
  }

  template <int dim>
  std::size_t GaussOperator<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return points->memory_consumption() + families->memory_consumption() + at_points.memory_consumption() +
           memory_consumption(half_modulus) + memory_consumption(far_factor);
  }

  PERIDEAL_INSTANTIATE_CLASS(GaussOperator)
} // namespace perideal
