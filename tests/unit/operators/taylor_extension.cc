// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/linear/polynomial_response.h>
#include <perideal/operators/linear/taylor_extension.h>
#include <perideal/operators/system/assembled_matrix.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>
#include <iomanip>
#include <sstream>

using namespace perideal;

namespace
{
  /// u = E x + half of H x x, with what it takes of displacements and tractions at a box.
  template <int dim>
  struct Field
  {
    dealii::Tensor<2, dim> gradient;
    /// d^2 u_c/dx_k dx_l, symmetric in the last two.
    std::array<dealii::SymmetricTensor<2, dim>, dim> curvature;

    dealii::Tensor<1, dim> value(const dealii::Point<dim> &x) const
    {
      dealii::Tensor<1, dim> result = gradient * x;
      for (int c = 0; c < dim; ++c)
        result[c] += 0.5 * (x * (curvature[c] * x));
      return result;
    }

    std::string displacement(const unsigned int c) const
    {
      std::string result = linear(gradient[c]);
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l)
          result += "+(" + number(0.5 * curvature[c][k][l]) + ")*" + axes[k] + "*" + axes[l];
      return result;
    }

    /// A component of C:grad u n.
    std::string traction(const dealii::SymmetricTensor<4, dim> &stiffness,
                         const dealii::Tensor<1, dim>          &normal,
                         const unsigned int                     component) const
    {
      std::string result;
      for (int m = 0; m < dim; ++m)
        for (int n = 0; n < dim; ++n)
          {
            double factor = 0;
            for (int j = 0; j < dim; ++j)
              factor += stiffness[component][j][m][n] * normal[j];
            const dealii::Tensor<2, dim> rows(curvature[m]);
            result += "+(" + number(factor) + ")*(" + number(gradient[m][n]) + "+" + linear(rows[n]) + ")";
          }
      return result;
    }

    /// div C:grad u.
    dealii::Tensor<1, dim> divergence(const dealii::SymmetricTensor<4, dim> &stiffness) const
    {
      dealii::Tensor<1, dim> result;
      for (int k = 0; k < dim; ++k)
        for (int j = 0; j < dim; ++j)
          for (int m = 0; m < dim; ++m)
            for (int n = 0; n < dim; ++n)
              result[k] += stiffness[k][j][m][n] * curvature[m][n][j];
      return result;
    }

    static std::string number(const double value)
    {
      std::ostringstream text;
      text << std::setprecision(17) << value;
      return text.str();
    }
    static std::string linear(const dealii::Tensor<1, dim> &row)
    {
      std::string result = "0";
      for (int d = 0; d < dim; ++d)
        result += "+(" + number(row[d]) + ")*" + axes[d];
      return result;
    }
    static constexpr std::array<const char *, 3> axes = {{"x", "y", "z"}};
  };

  const std::vector<std::string> models = {"bond based", "ordinary", "extended ordinary", "tensor involved"};

  /// A box under the tractions and displacements of a field, with the bonds of a model.
  template <int dim>
  struct LoadedBox
  {
    /// @param held faces with displacements; the others have tractions
    LoadedBox(const Mesh<dim>                 &mesh,
              const std::string               &model,
              const Field<dim>                &field,
              const std::vector<unsigned int> &held = {})
      : body(mesh)
      , field(field)
    {
      ModelParameters parameters;
      parameters.model = model;
      parameters.form  = parameters.is_tensor_involved() ? "one point" : "energy";
      parameters.resolve(dim);
      const ElasticSolid<dim> solid(parameters.constants_of_model(
        {70e9, 0.3, dim == 2 ? PlaneAssumption::plane_stress : PlaneAssumption::solid}));
      const auto              solid_of = [=](const dealii::types::material_id) { return solid; };
      plain     = create_bond_operator<dim>(body.families, *create_model<dim>(parameters, 1.), solid_of);
      faces     = find_boundary_faces(mesh, body.nodes);
      stiffness = make_ghosts(mesh, solid.stiffness(), solid.stiffness(), held)->stiffness();
      ghosts    = make_ghosts(mesh, stiffness, solid.stiffness(), held);
    }

    /// @param acting of the tractions
    std::shared_ptr<TaylorExtension<dim>> make_ghosts(const Mesh<dim>                       &mesh,
                                                      const dealii::SymmetricTensor<4, dim> &acting,
                                                      const dealii::SymmetricTensor<4, dim> &material,
                                                      const std::vector<unsigned int>       &held)
    {
      // Boundaries are numbered lower x, upper x, lower y, ...
      LoadParameters text;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        {
          BoundaryConditionText condition;
          condition.name     = "face " + std::to_string(f);
          condition.boundary = std::to_string(f);
          dealii::Tensor<1, dim> normal;
          normal[f / 2] = f % 2 == 0 ? -1. : 1.;
          for (unsigned int d = 0; d < dim; ++d)
            {
              if (std::count(held.begin(), held.end(), f) > 0)
                condition.displacement[d] = field.displacement(d);
              else
                condition.traction[d] = field.traction(acting, normal, d);
            }
          text.conditions.push_back(condition);
        }
      loads = resolve_boundaries(mesh, Loads<dim>(text));
      return std::make_shared<TaylorExtension<dim>>(
        plain, body.families, body.nodes, faces, gather_faces(faces, MPI_COMM_WORLD), loads, material);
    }

    NodalVector displacement() const
    {
      NodalVector result;
      ghosts->initialize(result);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        {
          const auto u = field.value(body.nodes.position[i]);
          for (int d = 0; d < dim; ++d)
            result.local_element(dim * i + d) = u[d];
        }
      return result;
    }

    /// Largest force on a node without balance under the field, over the largest without ghosts.
    double residual() const
    {
      NodalVector force, external;
      ghosts->initialize(force);
      ghosts->initialize(external);
      plain->vmult(force, displacement());
      const double before = force.linfty_norm();
      ghosts->vmult(force, displacement());
      ghosts->add_known(loads, 1., external);
      const auto body_force = -field.divergence(stiffness);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          external.local_element(dim * i + d) += body.nodes.volume[i] * body_force[d];
      force -= external;
      return force.linfty_norm() / before;
    }

    test::Body<dim>                       body;
    Field<dim>                            field;
    std::vector<BoundaryFace<dim>>        faces;
    Loads<dim>                            loads;
    dealii::SymmetricTensor<4, dim>       stiffness;
    std::shared_ptr<BondOperator<dim>>    plain;
    std::shared_ptr<TaylorExtension<dim>> ghosts;
  };

  /// Stretch, shear and rotation, and curvature where asked for.
  template <int dim>
  Field<dim> some_field(const bool is_curved)
  {
    Field<dim> result;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        {
          result.gradient[a][b] = 1e-3 * std::cos(1. + 2. * a - 3. * b);
          for (int c = 0; c < dim && is_curved; ++c)
            result.curvature[a][b][c] = 1e-3 * std::sin(1. + a + 2. * (b + c));
        }
    return result;
  }

  const std::vector<std::vector<unsigned int>> choices_of_held = {{}, {0, 3}};
} // namespace

TEST(TaylorExtension, FieldsOfSecondDegreeAreExactOnRegularPlates)
{
  // In the middle cells are deeper than two horizons of three cells, and tell the stiffness of families.
  const auto mesh = test::make_box<2>({16, 15}, {1.6, 1.5}, 0.);
  for (const std::string &model : models)
    for (const auto &held : choices_of_held)
      EXPECT_LT(LoadedBox<2>(*mesh, model, some_field<2>(true), held).residual(), 1e-9) << model;
}

TEST(TaylorExtension, FieldsOfSecondDegreeAreExactInRegularSolids)
{
  const auto mesh = test::make_box<3>({15, 15, 15}, {1.5, 1.5, 1.5}, 0.);
  EXPECT_LT(LoadedBox<3>(*mesh, "bond based", some_field<3>(true), {0, 3}).residual(), 1e-9);
}

TEST(TaylorExtension, UniformStressIsExactOnAnyMesh)
{
  for (const std::string &model : models)
    for (const auto &held : choices_of_held)
      {
        EXPECT_LT(LoadedBox<2>(*test::make_box<2>({16, 15}, {1., 1.}, 0.3), model, some_field<2>(false), held)
                    .residual(),
                  1e-10)
          << model;
        EXPECT_LT(
          LoadedBox<3>(*test::make_box<3>({5, 5, 4}, {1., 1., 0.8}, 0.25), model, some_field<3>(false), held)
            .residual(),
          1e-10)
          << model;
      }
}

TEST(TaylorExtension, UniformStressIsExactInAStripOneCellThick)
{
  // Members on a line do not tell the gradient across it; the faces do.
  const auto mesh = test::make_box<2>({12, 1}, {1.2, 0.1}, 0.);
  EXPECT_LT(LoadedBox<2>(*mesh, "bond based", some_field<2>(false)).residual(), 1e-9);
}

TEST(TaylorExtension, StandNearSurfacesOfRegularMeshesOnly)
{
  const auto         mesh = test::make_box<2>({14, 13}, {1.4, 1.3}, 0.);
  const LoadedBox<2> box(*mesh, "bond based", some_field<2>(true));
  // Inside are 8 x 7 cells, three from any side.
  EXPECT_EQ(dealii::Utilities::MPI::sum(box.ghosts->n_incomplete(), MPI_COMM_WORLD), 14u * 13u - 8u * 7u);
}

TEST(TaylorExtension, FindTheStiffnessOfTheLattice)
{
  // C_ijkl = c/2 sum V xi_i xi_j xi_k xi_l/|xi|^3, a sum over the lattice.
  const auto         mesh = test::make_box<2>({16, 15}, {1.6, 1.5}, 0.);
  const LoadedBox<2> box(*mesh, "bond based", some_field<2>(true));
  const double       h = 0.1, horizon = 3.01 * h;
  double             xxxx = 0, xxyy = 0;
  for (int a = -3; a <= 3; ++a)
    for (int b = -3; b <= 3; ++b)
      if (const double r = h * std::hypot(a, b); r > 0 && r <= horizon)
        {
          xxxx += std::pow(h * a, 4) / std::pow(r, 3) * h * h;
          xxyy += std::pow(h * a * h * b, 2) / std::pow(r, 3) * h * h;
        }
  const double c = 9. * 70e9 / (dealii::numbers::PI * std::pow(horizon, 3));
  EXPECT_NEAR(box.stiffness[0][0][0][0], 0.5 * c * xxxx, 1e-9 * c * xxxx);
  EXPECT_NEAR(box.stiffness[1][1][1][1], 0.5 * c * xxxx, 1e-9 * c * xxxx);
  EXPECT_NEAR(box.stiffness[0][0][1][1], 0.5 * c * xxyy, 1e-9 * c * xxxx);
  EXPECT_NEAR(box.stiffness[0][1][0][1], 0.5 * c * xxyy, 1e-9 * c * xxxx);
}

TEST(TaylorExtension, FacesCarryTheLoad)
{
  // Force and moment of every face, for any displacement: own faces are met exactly.
  const auto         mesh = test::make_box<2>({14, 13}, {1.4, 1.3}, 0.3);
  const LoadedBox<2> box(*mesh, "extended ordinary", some_field<2>(false));
  NodalVector        displacement;
  box.ghosts->initialize(displacement);
  for (LocalIndex i = 0; i < box.body.nodes.size(); ++i)
    for (int d = 0; d < 2; ++d)
      displacement.local_element(2 * i + d) = 1e-3 * test::scatter(box.body.nodes.position[i], d);
  dealii::Tensor<1, 2> seen, applied;
  for (const auto &face : box.ghosts->face_tractions(displacement, box.loads, 1.))
    if (face.boundary == 1)
      seen += face.point.area * face.traction;
  for (const BoundaryFace<2> &face : box.faces)
    if (face.boundary == 1)
      applied += face.area * Loads<2>::traction(box.loads.conditions[1], face.centre, face.normal, 1.);
  seen    = dealii::Utilities::MPI::sum(seen, MPI_COMM_WORLD);
  applied = dealii::Utilities::MPI::sum(applied, MPI_COMM_WORLD);
  EXPECT_LT((seen - applied).norm(), 1e-9 * applied.norm());
}

TEST(TaylorExtension, AssembleWhatTheyMultiply)
{
  const auto                             mesh = test::make_box<2>({7, 6}, {1., 0.9}, 0.3);
  const LoadedBox<2>                     box(*mesh, "bond based", some_field<2>(true), {0});
  const ConstrainedOperator<2>           system(box.ghosts,
                                      std::make_shared<MirrorLayer<2>>(box.body.nodes),
                                      box.body.nodes,
                                      std::vector<std::uint8_t>(2 * box.body.nodes.size(), 0));
  dealii::TrilinosWrappers::SparseMatrix matrix;
  assemble_matrix(system, matrix);
  NodalVector source, product, force;
  for (NodalVector *vector : {&source, &product, &force})
    system.initialize(*vector);
  for (LocalIndex i = 0; i < box.body.nodes.size(); ++i)
    for (int d = 0; d < 2; ++d)
      source.local_element(2 * i + d) = test::scatter(box.body.nodes.position[i], d);
  matrix.vmult(product, source);
  system.vmult(force, source);
  const double scale  = product.linfty_norm();
  const auto   blocks = box.ghosts->jacobi_blocks();
  const auto   first  = product.get_partitioner()->local_range().first;
  for (LocalIndex i = 0; i < blocks.size(); ++i)
    for (int a = 0; a < 2; ++a)
      {
        EXPECT_NEAR(product.local_element(2 * i + a), force.local_element(2 * i + a), 1e-12 * scale);
        for (int b = 0; b < 2; ++b)
          EXPECT_NEAR(blocks[i][a][b], matrix.el(first + 2 * i + a, first + 2 * i + b), 1e-12 * scale);
      }
}
