// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/linear/tangent_operator.h>

#include <deal.II/base/mpi.h>

#include "bodies.h"
#include "springs.h"
#include "testing.h"

#include <functional>

using namespace perideal;

namespace
{
  using Variant = std::pair<std::string, std::string>;

  /// A body of unit modulus with its force, its tangent and its linear operator.
  template <int dim>
  struct TangentBody
  {
    TangentBody(const Mesh<dim> &mesh, const Variant &variant)
      : body(mesh)
    {
      ModelParameters parameters;
      parameters.model = variant.first;
      parameters.form  = variant.second;
      parameters.resolve(dim);
      const ElasticConstants own = parameters.constants_of_model(
        {1., 0.3, dim == 3 ? PlaneAssumption::solid : PlaneAssumption::plane_strain});
      weights                                              = weigh_bonds<dim>(body.families,
                                 *create_model<dim>(parameters, 1.),
                                 [&](const dealii::types::material_id) { return ElasticSolid<dim>(own); });
      const std::shared_ptr<const BondWeights<dim>> shared = weights;
      bonds                                                = create_bond_force<dim>(*weights);
      tangent                                              = create_tangent<dim>(shared);
      linear                                               = create_bond_operator<dim>(shared);
      for (NodalVector *vector : {&displacement, &force, &other_force, &result})
        tangent->initialize(*vector);
    }

    /// Lets bonds soften from a stretch of 0.04 on.
    void let_soften()
    {
      bonds->set_critical_stretch([](const LocalIndex, const LocalIndex) { return 0.12; },
                                  SofteningLaw("linear"),
                                  [](const LocalIndex, const LocalIndex) { return 0.04; });
      bonds->judge_bonds(Judgement::on_trial);
    }

    GlobalIndex n_unknowns() const { return dim * body.nodes.n_global; }

    /// Turned by 0.2, stretched by 0.1, sheared, and without pattern by a fiftieth of the spacing.
    void deform()
    {
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        {
          const auto &x = body.nodes.position[i];
          for (int d = 0; d < dim; ++d)
            displacement.local_element(dim * i + d) = (d == 0 ? 0.1 * x[0] - 0.2 * x[1] :
                                                       d == 1 ? 0.2 * x[0] - 0.05 * x[1] :
                                                                0.08 * x[0]) +
                                                      0.02 * body.nodes.spacing[i] * test::scatter(x, d);
        }
    }

    /// Adds to one unknown of all ranks.
    void move(const GlobalIndex unknown, const double distance)
    {
      const GlobalIndex first = dim * body.nodes.first_global;
      if (unknown >= first && unknown < first + dim * body.nodes.size())
        displacement.local_element(unknown - first) += distance;
    }

    /// A field without pattern that does not depend on the ranks.
    NodalVector scattered(const unsigned int seed) const
    {
      NodalVector field(force);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          field.local_element(dim * i + d) = test::scatter(body.nodes.position[i], 7 * seed + d);
      return field;
    }

    /// A column of the tangent in result, and by central differences (PDBC eq. B.5) in other_force.
    void compute_columns(const GlobalIndex unknown)
    {
      NodalVector unit;
      tangent->initialize(unit);
      const GlobalIndex first = dim * body.nodes.first_global;
      if (unknown >= first && unknown < first + dim * body.nodes.size())
        unit.local_element(unknown - first) = 1.;
      tangent->vmult(result, unit);
      double spacing = 1e300;
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        spacing = std::min(spacing, body.nodes.spacing[i]);
      const double step = perturbation * dealii::Utilities::MPI::min(spacing, MPI_COMM_WORLD);
      move(unknown, step);
      bonds->compute(force, displacement);
      move(unknown, -2 * step);
      bonds->compute(other_force, displacement);
      move(unknown, step);
      other_force.sadd(0.5 / step, -0.5 / step, force);
    }

    /// Largest difference of the tangent at the present state from central differences, over its largest
    /// entry.
    double error_of_columns()
    {
      double error = 0, largest = 0;
      for (GlobalIndex unknown = 0; unknown < n_unknowns(); ++unknown)
        {
          compute_columns(unknown);
          largest = std::max(largest, result.linfty_norm());
          result -= other_force;
          error = std::max(error, result.linfty_norm());
        }
      return error / largest;
    }

    test::Body<dim>                       body;
    std::shared_ptr<BondWeights<dim>>     weights;
    std::unique_ptr<BondForce<dim>>       bonds;
    std::unique_ptr<TangentOperator<dim>> tangent;
    std::unique_ptr<BondOperator<dim>>    linear;
    NodalVector                           displacement, force, other_force, result;
    /// Of central differences, over the smallest spacing.
    double perturbation = 1e-6;
  };

  /// Every model in a distorted body.
  template <int dim>
  void for_all(const std::function<void(TangentBody<dim> &)> &property)
  {
    dealii::Point<dim>              size;
    const std::vector<unsigned int> cells =
      dim == 2 ? std::vector<unsigned int>{7, 6} : std::vector<unsigned int>{5, 4, 4};
    for (int d = 0; d < dim; ++d)
      size[d] = cells[d] * 0.1;
    const auto mesh = test::make_box<dim>(cells, size, 0.2);
    for (const Variant &variant : test::bond_models)
      {
        SCOPED_TRACE(variant.first + ", " + variant.second);
        TangentBody<dim> body(*mesh, variant);
        property(body);
      }
  }

  /// Differences of the tangent from central differences: rounding over the perturbation makes some 1e-9,
  /// the single precision of the force's weights 6e-8, a term that is missing 1e-2 and more.
  constexpr double of_differences = 1e-6;

  template <int dim>
  void expect_central_differences()
  {
    for_all<dim>([](TangentBody<dim> &body) {
      body.deform();
      body.bonds->compute(body.force, body.displacement);
      body.tangent->linearise(*body.bonds);
      EXPECT_LT(body.error_of_columns(), of_differences);
    });
  }

  TEST(Tangent, CentralDifferences2D)
  {
    expect_central_differences<2>();
  }

  TEST(Tangent, CentralDifferences3D)
  {
    expect_central_differences<3>();
  }

  template <int dim>
  void expect_no_lost_bonds()
  {
    for_all<dim>([](TangentBody<dim> &body) {
      const GlobalIndex n_cut = body.bonds->cut([](const auto &a, const auto &b) {
        return (a[0] - 0.22) * (b[0] - 0.22) < 0 && std::min(a[1], b[1]) > 0.35;
      });
      EXPECT_GT(n_cut, 0u);
      body.bonds->set_critical_stretch([](const LocalIndex, const LocalIndex) { return 0.11; });
      body.deform();
      body.bonds->compute(body.force, body.displacement);
      const GlobalIndex n_broken = body.bonds->n_broken_now();
      EXPECT_GT(n_broken, 0u);
      EXPECT_LT(n_broken, body.body.families->n_bonds() / 2);
      body.bonds->judge_bonds(Judgement::on_trial);
      body.bonds->compute(body.force, body.displacement);
      body.tangent->linearise(*body.bonds);
      EXPECT_LT(body.error_of_columns(), of_differences);
    });
  }

  TEST(Tangent, LostBondsCarryNothing2D)
  {
    expect_no_lost_bonds<2>();
  }

  TEST(Tangent, LostBondsCarryNothing3D)
  {
    expect_no_lost_bonds<3>();
  }

  /// Bonds as they go on to soften, but bond tensors; the secant, the derivative with what is left of the
  /// bonds as it is.
  template <int dim>
  void expect_softening_tangent()
  {
    for_all<dim>([](TangentBody<dim> &body) {
      body.let_soften();
      body.deform();
      if (!body.weights->shape.bond_tensors)
        {
          body.bonds->compute(body.force, body.displacement);
          body.tangent->linearise(*body.bonds);
          // What is left of bonds is in single precision: 6e-8 of forces, which differences over small steps
          // feel.
          body.perturbation = 1e-5;
          EXPECT_LT(body.error_of_columns(), 3e-4);
          body.perturbation = 1e-6;
        }
      // Judged and a little less deformed, bonds keep what is left.
      body.bonds->judge_bonds(Judgement::for_good);
      body.bonds->compute(body.force, body.displacement);
      EXPECT_TRUE(body.bonds->softening_bonds().any_now(MPI_COMM_WORLD));
      EXPECT_EQ(body.bonds->n_broken_now(), 0u);
      body.displacement *= 0.98;
      body.bonds->judge_bonds(Judgement::on_trial);
      body.bonds->compute(body.force, body.displacement);
      body.tangent->linearise(*body.bonds, Slope::secant);
      EXPECT_LT(body.error_of_columns(), of_differences);
    });
  }

  TEST(Tangent, Softening2D)
  {
    expect_softening_tangent<2>();
  }

  TEST(Tangent, Softening3D)
  {
    expect_softening_tangent<3>();
  }

  template <int dim>
  void expect_linear_operator_at_rest()
  {
    for_all<dim>([](TangentBody<dim> &body) {
      const NodalVector field = body.scattered(1);
      body.linear->vmult(body.force, field);
      for (const bool computed : {false, true})
        {
          if (computed)
            {
              body.bonds->compute(body.other_force, body.displacement);
              body.tangent->linearise(*body.bonds);
            }
          body.tangent->vmult(body.result, field);
          body.result -= body.force;
          EXPECT_LE(body.result.linfty_norm(), 1e-12 * body.force.linfty_norm());
        }
    });
  }

  TEST(Tangent, LinearOperatorAtRest)
  {
    expect_linear_operator_at_rest<2>();
    expect_linear_operator_at_rest<3>();
  }

  template <int dim>
  void expect_symmetry_with_energy()
  {
    unsigned int n_symmetric = 0;
    for_all<dim>([&](TangentBody<dim> &body) {
      body.deform();
      body.bonds->compute(body.force, body.displacement);
      body.tangent->linearise(*body.bonds);
      const NodalVector a = body.scattered(1), b = body.scattered(2);
      body.tangent->vmult(body.force, a);
      body.tangent->vmult(body.result, b);
      const double asymmetry =
        std::abs(body.force * b - body.result * a) / (body.force.l2_norm() * b.l2_norm());
      if (body.tangent->is_symmetric())
        EXPECT_LT(asymmetry, 1e-13);
      else
        EXPECT_GT(asymmetry, 1e-5);
      n_symmetric += body.tangent->is_symmetric();
    });
    EXPECT_GE(n_symmetric, 3u);
    EXPECT_LT(n_symmetric, test::bond_models.size());
  }

  TEST(Tangent, SymmetricWithEnergy)
  {
    expect_symmetry_with_energy<2>();
    expect_symmetry_with_energy<3>();
  }

  template <int dim>
  void expect_same_entries(const bool softens)
  {
    for_all<dim>([&](TangentBody<dim> &body) {
      if (softens)
        body.let_soften();
      body.deform();
      body.bonds->compute(body.force, body.displacement);
      body.tangent->linearise(*body.bonds);
      const std::size_t   n = body.n_unknowns();
      std::vector<double> matrix(n * n, 0.), all(n * n);
      body.tangent->assemble(
        [&](const std::vector<GlobalIndex> &unknowns, const std::vector<double> &values) {
          for (std::size_t r = 0; r < unknowns.size(); ++r)
            for (std::size_t c = 0; c < unknowns.size(); ++c)
              matrix[unknowns[r] * n + unknowns[c]] += values[r * unknowns.size() + c];
        });
      dealii::Utilities::MPI::sum(matrix, MPI_COMM_WORLD, all);
      const auto        blocks = body.tangent->jacobi_blocks();
      const GlobalIndex first  = dim * body.body.nodes.first_global;
      double            error = 0, block_error = 0, largest = 0;
      for (GlobalIndex c = 0; c < n; ++c)
        {
          NodalVector unit(body.force);
          unit = 0.;
          if (c >= first && c < first + unit.locally_owned_size())
            unit.local_element(c - first) = 1.;
          body.tangent->vmult(body.result, unit);
          for (std::size_t r = 0; r < unit.locally_owned_size(); ++r)
            {
              const double entry = body.result.local_element(r);
              largest            = std::max(largest, std::abs(entry));
              error              = std::max(error, std::abs(entry - all[(first + r) * n + c]));
              if ((first + r) / dim == c / dim)
                block_error = std::max(block_error, std::abs(entry - blocks[r / dim][r % dim][c % dim]));
            }
        }
      EXPECT_LT(error, 1e-12 * largest);
      EXPECT_LT(block_error, 1e-12 * largest);
    });
  }

  TEST(Tangent, EntriesAreThoseOfTheProduct)
  {
    for (const bool softens : {false, true})
      {
        expect_same_entries<2>(softens);
        expect_same_entries<3>(softens);
      }
  }
} // namespace
