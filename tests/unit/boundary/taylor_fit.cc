// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/taylor_fit.h>
#include <perideal/parameters/elastic_solid.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>

using namespace perideal;

namespace
{
  constexpr unsigned int n = TaylorBasis<2>::n_coefficients;
  using Coefficients       = Eigen::Matrix<double, n, 1>;

  /// A distorted plate that is pulled on the right (boundary 1) and held on the left (boundary 0).
  struct Plate
  {
    Plate()
      : mesh(test::make_box<2>({10, 9}, {1., 1.}, 0.2))
      , body(*mesh)
    {
      LoadParameters text;
      text.conditions.resize(2);
      text.conditions[0].name         = "held";
      text.conditions[0].boundary     = "0";
      text.conditions[0].displacement = {{"3e-3+y", "2e-3", ""}};
      text.conditions[1].name         = "pulled";
      text.conditions[1].boundary     = "1";
      text.conditions[1].pressure     = "-1e6";
      loads                           = resolve_boundaries(*mesh, Loads<2>(text));
      stiffness = ElasticSolid<2>({70e9, 0.3, PlaneAssumption::plane_stress}).stiffness();
      faces     = find_boundary_faces(*mesh, body.nodes);
      surface   = gather_faces(faces, MPI_COMM_WORLD);
    }

    /// The faces of a node's own cell, and the others that its horizon reaches.
    std::vector<TaylorFit<2>::NearFace> faces_of(const LocalIndex i) const
    {
      std::vector<TaylorFit<2>::NearFace> result;
      for (const auto &face : surface)
        if (face.centre.distance(body.nodes.position[i]) < body.nodes.horizon[i])
          result.emplace_back(&face, std::any_of(faces.begin(), faces.end(), [&](const auto &own) {
            return own.node == i && own.centre.distance(face.centre) < 1e-9;
          }));
      return result;
    }

    std::unique_ptr<Mesh<2>>      mesh;
    test::Body<2>                 body;
    Loads<2>                      loads;
    dealii::SymmetricTensor<4, 2> stiffness;
    std::vector<BoundaryFace<2>>  faces;
    std::vector<SurfaceFace<2>>   surface;
  };

  /// Coefficients for displacements of the family that scatter, and the values that the loads give.
  Coefficients coefficients(const Plate &plate, const TaylorPolynomial<2> &polynomial)
  {
    Eigen::VectorXd u(2 * polynomial.nodes.size()), known(polynomial.known.size());
    for (std::size_t a = 0; a < polynomial.nodes.size(); ++a)
      for (int d = 0; d < 2; ++d)
        u[2 * a + d] = 1e-3 * test::scatter(plate.body.families->position[polynomial.nodes[a]], d);
    for (std::size_t k = 0; k < polynomial.known.size(); ++k)
      known[k] = polynomial.known[k].at(plate.loads, 1.);
    return polynomial.of_nodes * u + polynomial.of_known * known;
  }
} // namespace

TEST(TaylorFit, ReproducesPolynomialsOfSecondDegree)
{
  const Plate        plate;
  const TaylorFit<2> fit(*plate.body.families, plate.loads, plate.stiffness);
  for (LocalIndex i = 0; i < plate.body.nodes.size(); ++i)
    {
      const auto   polynomial = fit.fit(i, {});
      Coefficients wanted;
      for (unsigned int k = 0; k < n; ++k)
        wanted[k] = std::cos(1. + 2. * k);
      Eigen::VectorXd u = Eigen::VectorXd::Zero(2 * polynomial.nodes.size());
      for (std::size_t a = 1; a < polynomial.nodes.size(); ++a)
        {
          const auto monomials = TaylorBasis<2>::monomials(
            (plate.body.families->position[polynomial.nodes[a]] - plate.body.nodes.position[i]) /
            plate.body.nodes.spacing[i]);
          for (unsigned int c = 0; c < 2; ++c)
            u[2 * a + c] =
              wanted.segment(c * TaylorBasis<2>::n_monomials, TaylorBasis<2>::n_monomials).dot(monomials);
        }
      EXPECT_LT((polynomial.of_nodes * u - wanted).norm(), 1e-9);
    }
}

TEST(TaylorFit, MeetsWhatIsKnownOfTheFacesOfItsCell)
{
  const Plate        plate;
  const TaylorFit<2> fit(*plate.body.families, plate.loads, plate.stiffness);
  const auto        &nodes = plate.body.nodes;
  for (const BoundaryFace<2> &face : plate.faces)
    {
      const auto   polynomial = fit.fit(face.node, plate.faces_of(face.node));
      const auto   c          = coefficients(plate, polynomial);
      const auto   d          = (face.centre - nodes.position[face.node]) / nodes.spacing[face.node];
      const double pull       = face.boundary == 1 ? 1e6 : 0.;
      for (unsigned int k = 0; k < 2; ++k)
        if (face.boundary == 0)
          {
            const auto own   = 1e-3 * test::scatter(nodes.position[face.node], k);
            const auto value = own + TaylorBasis<2>::monomials(d).dot(c.segment(
                                       k * TaylorBasis<2>::n_monomials, TaylorBasis<2>::n_monomials));
            EXPECT_NEAR(value, k == 0 ? 3e-3 + face.centre[1] : 2e-3, 1e-11);
          }
        else
          EXPECT_NEAR(TaylorBasis<2>::traction(d, plate.stiffness, face.normal, k).dot(c) /
                        nodes.spacing[face.node],
                      pull * face.normal[k],
                      1e-2);
    }
}

TEST(TaylorFit, InsideReproducesLinearFields)
{
  const Plate        plate;
  const TaylorFit<2> fit(*plate.body.families, plate.loads, plate.stiffness);
  for (LocalIndex i = 0; i < plate.body.nodes.size(); ++i)
    {
      const auto      polynomial = fit.fit_inside(i);
      Eigen::VectorXd u(2 * polynomial.nodes.size());
      for (std::size_t a = 0; a < polynomial.nodes.size(); ++a)
        {
          const auto &x = plate.body.families->position[polynomial.nodes[a]];
          u[2 * a]      = 7. + 2. * x[0] - x[1];
          u[2 * a + 1]  = -3. * x[0] + 4. * x[1];
        }
      const Coefficients c = polynomial.of_nodes * u / plate.body.nodes.spacing[i];
      EXPECT_NEAR(c[0], 2., 1e-11);
      EXPECT_NEAR(c[1], -1., 1e-11);
      EXPECT_NEAR(c[TaylorBasis<2>::n_monomials], -3., 1e-11);
      EXPECT_NEAR(c[TaylorBasis<2>::n_monomials + 1], 4., 1e-11);
    }
}
