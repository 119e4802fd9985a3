// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/elastic_state.h>
#include <perideal/materials/models.h>
#include <perideal/parameters/elastic_constants.h>

#include "bodies.h"
#include "moments.h"
#include "testing.h"

using namespace perideal;

namespace
{
  /// A box of the consistent form with a crack in the plane half way up, in its middle.
  template <int dim>
  struct CrackedBox
  {
    CrackedBox(const Mesh<dim> &mesh, const double half_width)
      : body(mesh, 2.01)
      , solid(ElasticConstants{70e9, 0.3, dim == 2 ? PlaneAssumption::plane_stress : PlaneAssumption::solid})
    {
      ModelParameters parameters;
      parameters.resolve(dim);
      const BondPredicate<dim> is_cut = [half_width](const auto &a, const auto &b) {
        return is_above(a) != is_above(b) && std::abs(0.5 * (a[0] + b[0]) - 0.5) < half_width;
      };
      moments = test::make_moments(mesh, body.nodes, std::make_shared<const FaceValues<dim>>(), is_cut);
      bonds   = test::make_consistent_operator<dim>(
        body.families,
        moments,
        create_consistent<dim>(parameters, 2.01),
        [this](const auto) { return solid; },
        is_cut);
      bonds->initialize(force);
      bonds->initialize(displacement);
    }

    static bool is_above(const dealii::Point<dim> &x) { return x[dim - 1] > 0.5; }

    template <typename Displacement>
    const NodalVector &force_of(const Displacement &function)
    {
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          displacement.local_element(dim * i + d) = function(body.nodes.position[i])[d];
      bonds->vmult(force, displacement);
      return force;
    }

    test::Body<dim>                             body;
    ElasticSolid<dim>                           solid;
    std::shared_ptr<const GradientMoments<dim>> moments;
    std::shared_ptr<ConsistentOperator<dim>>    bonds;
    NodalVector                                 force, displacement;
  };

  template <int dim>
  std::unique_ptr<Mesh<dim>> make_cube()
  {
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = 1.;
    return test::make_box<dim>(std::vector<unsigned int>(dim, 10), size, 0.);
  }

  /// Faces free of traction may be open: a pull along the crack does not feel it, one across it does.
  template <int dim>
  void expect_pull_along_crack_to_pass()
  {
    const auto      mesh = make_cube<dim>();
    CrackedBox<dim> whole(*mesh, 0.), cracked(*mesh, 0.11);
    EXPECT_EQ(whole.moments->faces().n_open_faces(), 0u);
    EXPECT_EQ(
      dealii::Utilities::MPI::sum<std::size_t>(cracked.moments->faces().n_open_faces(), MPI_COMM_WORLD),
      dim == 2 ? 4u : 40u);
    for (const int axis : {0, dim - 1})
      {
        const auto pulled = [&](const dealii::Point<dim> &x) {
          dealii::Tensor<1, dim> u;
          for (int d = 0; d < dim; ++d)
            u[d] = 1e-3 * (d == axis ? 1. : -0.3) * x[d];
          return u;
        };
        NodalVector  difference = whole.force_of(pulled);
        const double size       = difference.linfty_norm();
        difference -= cracked.force_of(pulled);
        if (axis == 0)
          EXPECT_LE(difference.linfty_norm(), 1e-12 * size);
        else
          EXPECT_GE(difference.linfty_norm(), 0.1 * size);
      }
  }

  /// Halves that a crack separates move as they like.
  template <int dim>
  void expect_halves_to_move_freely()
  {
    const auto      mesh = make_cube<dim>();
    CrackedBox<dim> cracked(*mesh, 1.);
    const double    size = cracked
                          .force_of([](const dealii::Point<dim> &x) {
                            dealii::Tensor<1, dim> u;
                            u[0] = 1e-3 * x[0];
                            return u;
                          })
                          .linfty_norm();
    const auto &force = cracked.force_of([](const dealii::Point<dim> &x) {
      dealii::Tensor<1, dim> u;
      const double           sign = CrackedBox<dim>::is_above(x) ? 1. : -2.;
      u[0]                        = sign * 1e-3 * (1. - x[1]);
      u[1]                        = sign * 1e-3 * (2. + x[0]);
      return u;
    });
    EXPECT_LE(force.linfty_norm(), 1e-12 * size);
  }
} // namespace

TEST(OpenFaces, DoNotFeelAPullAlongThem2D)
{
  expect_pull_along_crack_to_pass<2>();
}
TEST(OpenFaces, DoNotFeelAPullAlongThem3D)
{
  expect_pull_along_crack_to_pass<3>();
}
TEST(OpenFaces, LetHalvesMove2D)
{
  expect_halves_to_move_freely<2>();
}
TEST(OpenFaces, LetHalvesMove3D)
{
  expect_halves_to_move_freely<3>();
}
