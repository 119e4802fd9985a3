// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/boundary_faces.h>
#include <perideal/materials/elastic_state.h>
#include <perideal/materials/models.h>
#include <perideal/operators/linear/consistent_operator.h>
#include <perideal/parameters/elastic_constants.h>
#include <perideal/treatments/treatments.h>

#include "bodies.h"
#include "moments.h"
#include "solids.h"
#include "testing.h"

using namespace perideal;

namespace
{
  /// A body whose boundaries (numbered as by hyper_rectangle) have conditions.
  template <int dim>
  struct LoadedBody
  {
    LoadedBody(const Mesh<dim>                      &mesh,
               const LoadParameters                 &text,
               const std::vector<ElasticSolid<dim>> &materials)
      : mesh(&mesh)
      , body(mesh, horizon_factor)
      , faces(find_boundary_faces(mesh, body.nodes))
      , loads(resolve_boundaries(mesh, Loads<dim>(text)))
      , solid_of([materials](const dealii::types::material_id id) { return materials[id]; })
    {
      ModelParameters parameters;
      parameters.resolve(dim);
      const auto polynomials  = std::make_shared<const CellPolynomials<dim>>(mesh, body.nodes);
      const auto face_moments = std::make_shared<const FaceMoments<dim>>(
        mesh, *polynomials, [&](const auto id) { return solid_of(id).isotropic().shear_modulus(); });
      values = std::make_shared<FaceValues<dim>>(face_moments->boundary_points(), loads);
      values->set_time(loads, 1.);
      moments =
        std::make_shared<const GradientMoments<dim>>(polynomials, face_moments, values, MPI_COMM_WORLD);
      tractions = load_by_face_value<dim>({mesh, body.nodes, faces, loads, text, timings},
                                          {body.families, moments, solid_of});
      bonds     = test::make_consistent_operator<dim>(
        body.families, moments, create_consistent<dim>(parameters, horizon_factor), solid_of);
      for (NodalVector *vector : {&displacement, &force, &external})
        bonds->initialize(*vector);
    }

    /// Largest component of internal minus external force under a displacement, over the largest one that
    /// bonds have under its means alone.
    /// @param curvature second derivatives of each component
    template <typename Displacement>
    double residual(const Displacement                                     &function,
                    const std::array<dealii::SymmetricTensor<2, dim>, dim> &curvature = {})
    {
      const CellPolynomials<dim> &cells = moments->cell_polynomials();
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          displacement.local_element(dim * i + d) =
            function(cells.centroids()[i])[d] + 0.5 * curvature[d] * cells.second_moments()[i];
      external = 0.;
      moments->add_body_forces(*mesh, body.nodes, loads, 1., external);
      tractions->add_tractions(loads, 1., external);
      bonds->internal_force(force, displacement);
      double size = 0, worst = 0;
      for (LocalIndex k = 0; k < dim * body.nodes.size(); ++k)
        worst = std::max(worst, std::abs(force.local_element(k) - external.local_element(k)));
      bonds->vmult(force, displacement);
      for (LocalIndex k = 0; k < dim * body.nodes.size(); ++k)
        size = std::max(size, std::abs(force.local_element(k)));
      // The reactions are those of internal_force().
      bonds->internal_force(force, displacement);
      return dealii::Utilities::MPI::max(worst, MPI_COMM_WORLD) /
             dealii::Utilities::MPI::max(size, MPI_COMM_WORLD);
    }

    static constexpr double                     horizon_factor = 2.01;
    const Mesh<dim>                            *mesh;
    test::Body<dim>                             body;
    std::vector<BoundaryFace<dim>>              faces;
    Loads<dim>                                  loads;
    SolidOf<dim>                                solid_of;
    std::shared_ptr<const GradientMoments<dim>> moments;
    Timings                                     timings{MPI_COMM_WORLD};
    std::unique_ptr<Tractions<dim>>             tractions;
    std::shared_ptr<FaceValues<dim>>            values;
    std::shared_ptr<ConsistentOperator<dim>>    bonds;
    NodalVector                                 displacement, force, external;
  };

  /// A linear displacement and, as formulas, the conditions that belong to it.
  template <int dim>
  struct Patch
  {
    explicit Patch(const ElasticSolid<dim> &solid)
    {
      for (int r = 0; r < dim; ++r)
        for (int c = 0; c < dim; ++c)
          gradient[r][c] = 1e-3 * (1. + 2. * r - 0.7 * c + (r == c ? 0.3 : 0.) - 1.9 * r * c);
      const ElasticState state = elastic_state<dim>(symmetrize(gradient), solid);
      for (int r = 0; r < dim; ++r)
        for (int c = r; c < dim; ++c)
          stress[r][c] = state.stress[r][c];
    }

    dealii::Tensor<1, dim> operator()(const dealii::Point<dim> &x) const { return gradient * x; }

    /// The boundary numbered @p id is pulled by the traction of the stress.
    BoundaryConditionText pulled(const unsigned int id) const
    {
      BoundaryConditionText result;
      result.name = result.boundary = std::to_string(id);
      for (int d = 0; d < dim; ++d)
        result.traction[d] = test::formula((id % 2 == 0 ? -1. : 1.) * stress[d][id / 2]);
      return result;
    }

    /// The component of the displacement as a formula.
    std::string formula(const unsigned int component) const { return test::formula(gradient, component); }

    dealii::Tensor<2, dim>          gradient;
    dealii::SymmetricTensor<2, dim> stress;
  };

  /// A quadratic displacement and, as formulas, the conditions and the body force that belong to it.
  template <int dim>
  struct QuadraticPatch
  {
    explicit QuadraticPatch(const ElasticSolid<dim> &solid)
      : stiffness(solid.stiffness())
    {
      for (int r = 0; r < dim; ++r)
        for (int c = 0; c < dim; ++c)
          {
            gradient[r][c] = 1e-3 * (0.4 + r - 0.6 * c);
            for (int k = 0; k <= c; ++k)
              curvature[r][c][k] =
                1e-3 * (0.7 - r + 0.8 * c - 1.1 * k + 0.9 * r * c * k + (r == k ? 0.5 : 0.));
          }
    }

    dealii::Tensor<1, dim> operator()(const dealii::Point<dim> &x) const
    {
      dealii::Tensor<1, dim> result = gradient * x;
      for (int r = 0; r < dim; ++r)
        result[r] += 0.5 * (x * (curvature[r] * x));
      return result;
    }

    /// Stress at the origin, and what of it belongs to x along an axis.
    dealii::SymmetricTensor<2, dim> stress() const { return stiffness * symmetrize(gradient); }
    dealii::SymmetricTensor<2, dim> stress_along(const unsigned int axis) const
    {
      dealii::Tensor<2, dim> change;
      for (int r = 0; r < dim; ++r)
        for (int c = 0; c < dim; ++c)
          change[r][c] = curvature[r][c][axis];
      return stiffness * symmetrize(change);
    }

    BoundaryConditionText pulled(const unsigned int id) const
    {
      BoundaryConditionText result;
      result.name = result.boundary = std::to_string(id);
      for (int d = 0; d < dim; ++d)
        {
          dealii::Tensor<2, dim> slope;
          for (int k = 0; k < dim; ++k)
            slope[d][k] = (id % 2 == 0 ? -1. : 1.) * stress_along(k)[d][id / 2];
          result.traction[d] =
            test::formula((id % 2 == 0 ? -1. : 1.) * stress()[d][id / 2]) + " + " + test::formula(slope, d);
        }
      return result;
    }

    std::string body_force(const unsigned int component) const
    {
      double force = 0;
      for (int k = 0; k < dim; ++k)
        force -= stress_along(k)[component][k];
      return test::formula(force);
    }

    /// The component of the displacement as a formula.
    std::string formula(const unsigned int component) const
    {
      const char *const axes[] = {"x", "y", "z"};
      std::string       text   = test::formula(gradient, component);
      for (int r = 0; r < dim; ++r)
        for (int c = 0; c < dim; ++c)
          text += " + " + test::formula(0.5 * curvature[component][r][c]) + "*" + axes[r] + "*" + axes[c];
      return text;
    }

    dealii::SymmetricTensor<4, dim>                  stiffness;
    dealii::Tensor<2, dim>                           gradient;
    std::array<dealii::SymmetricTensor<2, dim>, dim> curvature;
  };

  template <int dim>
  ElasticConstants constants()
  {
    return {70e9, 0.3, dim == 2 ? PlaneAssumption::plane_stress : PlaneAssumption::solid};
  }

  /// An isotropic solid and one without any symmetry.
  template <int dim>
  std::vector<ElasticSolid<dim>> solids()
  {
    return {constants<dim>(), test::solid_without_symmetry<dim>()};
  }

  template <int dim>
  void expect_patch_under_tractions(const ElasticSolid<dim> &solid)
  {
    for (const auto &mesh : test::make_boxes<dim>())
      {
        const Patch<dim> patch(solid);
        LoadParameters   text;
        for (unsigned int id = 0; id < 2 * dim; ++id)
          text.conditions.push_back(patch.pulled(id));
        LoadedBody<dim> loaded(*mesh, text, {solid});
        EXPECT_LE(loaded.residual(patch), 1e-11);
      }
  }

  template <int dim>
  void expect_patch_under_mixed_conditions(const ElasticSolid<dim> &solid)
  {
    for (const auto &mesh : test::make_boxes<dim>())
      {
        // The left face is held altogether, the right one along x only, the rest is pulled.
        const Patch<dim> patch(solid);
        LoadParameters   text;
        for (unsigned int id = 0; id < 2 * dim; ++id)
          text.conditions.push_back(patch.pulled(id));
        for (int d = 0; d < dim; ++d)
          {
            text.conditions[0].traction[d].clear();
            text.conditions[0].displacement[d] = patch.formula(d);
          }
        text.conditions[1].traction[0].clear();
        text.conditions[1].displacement[0] = patch.formula(0);
        LoadedBody<dim> loaded(*mesh, text, {solid});
        EXPECT_LE(loaded.residual(patch), 1e-11);

        // Reactions: minus the resultant of all the tractions, and sigma A each.
        const auto forces = loaded.bonds->support_forces();
        const auto sums   = loaded.values->sum_by_condition(forces, MPI_COMM_WORLD);
        double     area   = 0;
        for (const auto &point : loaded.moments->faces().boundary_points())
          if (point.boundary == 0)
            area += point.area.norm();
        area = dealii::Utilities::MPI::sum(area, MPI_COMM_WORLD);
        for (int d = 0; d < dim; ++d)
          EXPECT_NEAR(sums[0][d], -area * patch.stress[d][0], 1e-11 * area * patch.stress.norm());
        EXPECT_NEAR(sums[1][0], area * patch.stress[0][0], 1e-11 * area * patch.stress.norm());
        EXPECT_EQ(sums[1][1], 0.);
      }
  }

  /// Whatever the cells' shape, quadratic displacements are in equilibrium with their loads: all faces
  /// pulled, or one held and one held along its normal.
  template <int dim>
  void expect_quadratic_fields(const ElasticSolid<dim> &solid)
  {
    for (const bool held : {false, true})
      for (const auto &mesh : test::make_boxes<dim>())
        {
          const QuadraticPatch<dim> patch(solid);
          LoadParameters            text;
          for (unsigned int id = 0; id < 2 * dim; ++id)
            text.conditions.push_back(patch.pulled(id));
          for (int d = 0; d < dim; ++d)
            {
              text.body_force[d] = patch.body_force(d);
              if (held)
                {
                  text.conditions[0].traction[d].clear();
                  text.conditions[0].displacement[d] = patch.formula(d);
                }
            }
          if (held)
            {
              text.conditions[1].traction[0].clear();
              text.conditions[1].displacement[0] = patch.formula(0);
            }
          LoadedBody<dim> loaded(*mesh, text, {solid});
          EXPECT_LE(loaded.residual(patch, patch.curvature), 1e-11);
          // The polynomials are the field itself.
          loaded.moments->read(loaded.displacement, GradientMoments<dim>::AtFaces::values);
          for (LocalIndex i = 0; i < loaded.body.nodes.size(); ++i)
            {
              const auto expected = patch(loaded.moments->cell_polynomials().centroids()[i]);
              for (int d = 0; d < dim; ++d)
                EXPECT_NEAR(loaded.moments->polynomial(i)->value[d], expected[d], 1e-15);
            }
        }
  }

  /// Two materials meet at a plane and are pulled across it: each has its own uniform strain.
  template <int dim>
  void expect_patch_of_two_materials()
  {
    dealii::Point<dim>        size;
    std::vector<unsigned int> cells(dim, 6);
    for (int d = 0; d < dim; ++d)
      size[d] = 1.;
    const auto mesh = test::make_box<dim>(cells, size, 0.);
    for (const auto &cell : mesh->triangulation.active_cell_iterators())
      if (!cell->is_artificial())
        cell->set_material_id(cell->center()[0] > 0.5);
    mesh->material_ids = {0, 1};
    // Held laterally: uniaxial strain.
    std::vector<ElasticConstants> materials = {constants<dim>(), constants<dim>()};
    materials[1].young_modulus *= 100.;
    const double pull = 1e7;
    const auto   wave = [&](const unsigned int m) {
      return materials[m].bulk_modulus() + 2. * materials[m].shear_modulus() * (dim - 1.) / dim;
    };
    LoadParameters text;
    text.conditions.resize(2 * dim);
    for (unsigned int id = 0; id < 2 * dim; ++id)
      {
        text.conditions[id].name = text.conditions[id].boundary = std::to_string(id);
        if (id != 1)
          text.conditions[id].displacement[id / 2] = "0";
        else
          text.conditions[id].traction[0] = test::formula(pull);
      }
    LoadedBody<dim> loaded(*mesh, text, {materials[0], materials[1]});
    EXPECT_LE(loaded.residual([&](const dealii::Point<dim> &x) {
      dealii::Tensor<1, dim> u;
      u[0] = pull / wave(0) * std::min(x[0], 0.5) + pull / wave(1) * std::max(x[0] - 0.5, 0.);
      return u;
    }),
              1e-11);
  }

  /// A body one cell thick has no gradient across, and says so.
  template <int dim>
  void expect_thin_bodies_to_be_reported()
  {
    dealii::Point<dim>        size;
    std::vector<unsigned int> cells(dim, 6);
    for (int d = 0; d < dim; ++d)
      size[d] = 1.;
    cells[1]             = 1;
    const auto      mesh = test::make_box<dim>(cells, size, 0.);
    LoadedBody<dim> loaded(*mesh, {}, {constants<dim>()});
    EXPECT_EQ(loaded.bonds->counts.singular, mesh->triangulation.n_global_active_cells());
  }
} // namespace

TEST(ConsistentOperator, PatchUnderTractions2D)
{
  for (const auto &solid : solids<2>())
    expect_patch_under_tractions(solid);
}
TEST(ConsistentOperator, PatchUnderTractions3D)
{
  for (const auto &solid : solids<3>())
    expect_patch_under_tractions(solid);
}
TEST(ConsistentOperator, QuadraticFields2D)
{
  for (const auto &solid : solids<2>())
    expect_quadratic_fields(solid);
}
TEST(ConsistentOperator, QuadraticFields3D)
{
  for (const auto &solid : solids<3>())
    expect_quadratic_fields(solid);
}
TEST(ConsistentOperator, PatchUnderMixedConditions2D)
{
  for (const auto &solid : solids<2>())
    expect_patch_under_mixed_conditions(solid);
}
TEST(ConsistentOperator, PatchUnderMixedConditions3D)
{
  for (const auto &solid : solids<3>())
    expect_patch_under_mixed_conditions(solid);
}
TEST(ConsistentOperator, PatchOfTwoMaterials2D)
{
  expect_patch_of_two_materials<2>();
}
TEST(ConsistentOperator, PatchOfTwoMaterials3D)
{
  expect_patch_of_two_materials<3>();
}
TEST(ConsistentOperator, ReportsThinBodies2D)
{
  expect_thin_bodies_to_be_reported<2>();
}
TEST(ConsistentOperator, ReportsThinBodies3D)
{
  expect_thin_bodies_to_be_reported<3>();
}
