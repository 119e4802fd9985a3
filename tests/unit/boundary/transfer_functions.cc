// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/face_tractions.h>
#include <perideal/boundary/published_transfer.h>
#include <perideal/mesh/create_mesh.h>
#include <perideal/treatments/treatments.h>

#include "bodies.h"
#include "testing.h"

using namespace perideal;
using test::expect_input_error;

namespace
{
  template <typename Value>
  Value sum(const Value &value)
  {
    return dealii::Utilities::MPI::sum(value, MPI_COMM_WORLD);
  }

  /// The boxes of every kind, and a plate whose hole makes curved sides of straight faces.
  template <int dim>
  std::vector<std::unique_ptr<Mesh<dim>>> make_bodies()
  {
    auto result = test::make_boxes<dim>();
    if (dim == 2)
      {
        MeshParameters plate;
        plate.generator = "plate with hole";
        plate.cells     = {6, 5};
        plate.size      = {1.};
        plate.thickness = 0.1;
        result.push_back(create_mesh<dim>(plate, MPI_COMM_WORLD, ""));
      }
    return result;
  }

  /// A body whose whole surface is pulled by a linear traction and pressed.
  template <int dim>
  struct Scene
  {
    explicit Scene(const Mesh<dim> &mesh)
      : mesh(mesh)
      , nodes(mesh, NodeParameters{3.01})
      , faces(find_boundary_faces(mesh, nodes))
      , functions(nodes, gather_faces(faces, MPI_COMM_WORLD))
    {
      BoundaryConditionText pull, press;
      pull.name  = "pull";
      press.name = "press";
      for (const auto id : mesh.boundary_ids)
        pull.boundary += (pull.boundary.empty() ? "" : ", ") + std::to_string(id);
      press.boundary  = pull.boundary;
      pull.traction   = {{"2-3*x+y", "1+5*x-2*y", dim == 3 ? "4-z+x" : ""}};
      press.pressure  = "1+x+2*y";
      text.conditions = {pull, press};
      loads           = resolve_boundaries(mesh, Loads<dim>(text));
    }

    template <typename Transfer>
    NodalVector forces_of(const Transfer &transfer) const
    {
      dealii::IndexSet owned(dim * nodes.n_global);
      owned.add_range(dim * nodes.first_global, dim * (nodes.first_global + nodes.size()));
      NodalVector force(owned, MPI_COMM_WORLD);
      transfer.add_tractions(loads, 1., force);
      return force;
    }

    Resultant<dim> of_nodes(const NodalVector &force) const
    {
      Resultant<dim> result;
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        {
          dealii::Tensor<1, dim> acting;
          for (int d = 0; d < dim; ++d)
            acting[d] = force.local_element(dim * i + d);
          result.add(nodes.position[i], acting);
        }
      return {sum(result.force), sum(result.moment)};
    }

    Resultant<dim> of_faces() const
    {
      Resultant<dim> result;
      for (const auto &condition : loads.conditions)
        for (const auto &face : faces)
          {
            const auto part = integrate_traction<dim>(condition, face, 1., dealii::Point<dim>());
            result.force += part.force;
            result.moment += part.moment;
          }
      return {sum(result.force), sum(result.moment)};
    }

    std::unique_ptr<Tractions<dim>> transfer()
    {
      return load_by_transfer<dim>({mesh, nodes, faces, loads, text, timings}, {});
    }

    const Mesh<dim>               &mesh;
    Nodes<dim>                     nodes;
    std::vector<BoundaryFace<dim>> faces;
    TransferFunctions<dim>         functions;
    LoadParameters                 text;
    Loads<dim>                     loads;
    Timings                        timings{MPI_COMM_WORLD};
  };

  /// (2.3), (2.4) and (2.5), relative to the sizes of the terms.
  template <int dim>
  void expect_constraints()
  {
    for (const auto &mesh : make_bodies<dim>())
      {
        const Scene<dim>    scene(*mesh);
        const auto         &f       = scene.functions;
        const std::size_t   n_faces = f.faces().size(), n = scene.nodes.size();
        std::vector<double> of_g(n_faces, 0.), of_l(n_faces, 0.), over_faces(n, 0.);
        for (std::size_t k = 0; k < n_faces; ++k)
          {
            std::vector<double> q(n, 0.);
            for (const auto &[i, value] : f.entries()[k])
              q[i] = value;
            for (std::size_t i = 0; i < n; ++i)
              {
                const double l = q[i] * f.double_sum() - f.face_sums()[i] * f.node_sums()[k];
                of_g[k] += q[i] / f.node_sums()[k] * scene.nodes.volume[i];
                of_l[k] += l * scene.nodes.volume[i];
                over_faces[i] += l * f.faces()[k].area;
              }
          }
        double area = 0;
        for (std::size_t k = 0; k < n_faces; ++k)
          {
            EXPECT_NEAR(sum(of_g[k]), 1., 1e-12);
            EXPECT_NEAR(sum(of_l[k]) / (f.node_sums()[k] * f.double_sum()), 0., 1e-12);
            area += f.faces()[k].area;
          }
        for (std::size_t i = 0; i < n; ++i)
          EXPECT_NEAR(over_faces[i] / (area * f.double_sum()), 0., 1e-12);
      }
  }

  template <int dim>
  void expect_force_and_moment()
  {
    for (const auto &mesh : make_bodies<dim>())
      {
        Scene<dim> scene(*mesh);
        const auto applied = scene.of_faces();
        const auto nodal   = scene.of_nodes(scene.forces_of(*scene.transfer()));
        EXPECT_LE((nodal.force - applied.force).norm(), 1e-12 * applied.force.norm());
        EXPECT_LE((nodal.moment - applied.moment).norm(), 1e-12 * applied.moment.norm());
      }
  }
} // namespace

TEST(TransferFunctions, FulfilTheirConstraints)
{
  expect_constraints<2>();
  expect_constraints<3>();
}

TEST(TransferFunctions, ReachEveryFace)
{
  // Cells sixty times as long as they are high: their nodes are four spacings from their short sides.
  const auto     mesh = test::make_box<2>({1, 60}, {1., 1.}, 0.);
  const Nodes<2> nodes(*mesh, NodeParameters{2.});
  const auto     faces = gather_faces(find_boundary_faces(*mesh, nodes), MPI_COMM_WORLD);
  expect_input_error([&] { TransferFunctions<2>(nodes, faces); },
                     {"horizon of no node", "Nodes/Horizon factor"});
}

TEST(FaceTractions, AreIntegralsOfLinearTractions)
{
  // The unit square: force and moment of its side x = 1 under t = (y, 0), thickness 1.
  const auto            mesh = test::make_box<2>({3, 2}, {1., 1.}, 0.);
  const Nodes<2>        nodes(*mesh, NodeParameters{3.01});
  LoadParameters        text;
  BoundaryConditionText pull;
  pull.name     = "pull";
  pull.boundary = "1";
  pull.traction = {{"y", "0", ""}};
  text.conditions.push_back(pull);
  const Loads<2> loads(text);
  Resultant<2>   total;
  for (const auto &face : find_boundary_faces(*mesh, nodes))
    if (face.boundary == 1)
      {
        const auto part = integrate_traction<2>(loads.conditions[0], face, 1., dealii::Point<2>());
        total.force += part.force;
        total.moment += part.moment;
      }
  // Round-off of a few additions.
  EXPECT_NEAR(sum(total.force)[0], 0.5, 1e-14);
  EXPECT_NEAR(sum(total.moment)[2], -1. / 3, 1e-14);
}

TEST(BalancedTransfer, CarriesForceAndMomentOfEveryFace)
{
  expect_force_and_moment<2>();
  expect_force_and_moment<3>();
}

/// On a straight side away from corners a uniform pull along the normal is q alone.
TEST(BalancedTransfer, IsTheTransferFunctionOnStraightSides)
{
  const auto            mesh = test::make_box<2>({12, 20}, {1.2, 2.}, 0.);
  const Nodes<2>        nodes(*mesh, NodeParameters{2.01});
  const auto            faces = find_boundary_faces(*mesh, nodes);
  BoundaryConditionText pull;
  pull.name     = "pull";
  pull.boundary = "1";
  pull.traction = {{"3", "", ""}};
  LoadParameters text;
  text.conditions.push_back(pull);
  const Loads<2>   loads = resolve_boundaries(*mesh, Loads<2>(text));
  dealii::IndexSet owned(2 * nodes.n_global);
  owned.add_range(2 * nodes.first_global, 2 * (nodes.first_global + nodes.size()));
  NodalVector balanced(owned, MPI_COMM_WORLD), published(owned, MPI_COMM_WORLD);
  Timings     timings(MPI_COMM_WORLD);
  load_by_transfer<2>({*mesh, nodes, faces, loads, text, timings}, {})->add_tractions(loads, 1., balanced);
  PublishedTransfer<2>(TransferFunctions<2>(nodes, gather_faces(faces, MPI_COMM_WORLD)), loads, 3.59, 0.)
    .add_tractions(loads, 1., published);
  for (LocalIndex i = 0; i < nodes.size(); ++i)
    if (std::abs(nodes.position[i][1] - 1.) < 0.5)
      {
        // Round-off of forces of 0.1.
        EXPECT_NEAR(balanced.local_element(2 * i), published.local_element(2 * i) * 2.59 / 3.59, 1e-14);
        EXPECT_NEAR(balanced.local_element(2 * i + 1), 0., 1e-14);
      }
}

/// The published factor multiplies the force.
TEST(PublishedTransfer, MultipliesTheForce)
{
  const auto     mesh = test::make_box<3>({5, 5, 4}, {1., 1., 0.8}, 0.25);
  const Scene<3> scene(*mesh);
  const auto     nodal =
    scene.of_nodes(scene.forces_of(PublishedTransfer<3>(scene.functions, scene.loads, 3.59, 0.)));
  const auto applied = scene.of_faces();
  EXPECT_LE((nodal.force - 3.59 / 2.59 * applied.force).norm(), 1e-12 * applied.force.norm());
}

/// What L does to the nodes against (2.17), sum by sum over dense matrices.
TEST(PublishedTransfer, HasTheSumsOfLAsPublished)
{
  const auto            mesh = test::make_box<2>({6, 5}, {1., 0.9}, 0.2);
  const Nodes<2>        nodes(*mesh, NodeParameters{3.01});
  const auto            faces = gather_faces(find_boundary_faces(*mesh, nodes), MPI_COMM_WORLD);
  BoundaryConditionText hold;
  hold.name         = "hold";
  hold.boundary     = "0, 3";
  hold.displacement = {{"0.1*y*t", "", ""}};
  LoadParameters text;
  text.conditions.push_back(hold);
  const Loads<2>             loads = resolve_boundaries(*mesh, Loads<2>(text));
  const double               chi = 3.59, lambda = 7.;
  TransferFunctions<2>       functions(nodes, faces);
  const PublishedTransfer<2> transfer(functions, loads, chi, lambda);
  dealii::IndexSet           owned(2 * nodes.n_global);
  owned.add_range(2 * nodes.first_global, 2 * (nodes.first_global + nodes.size()));
  NodalVector force(owned, MPI_COMM_WORLD);
  transfer.add_places(loads, 2., force);
  ASSERT_EQ(transfer.springs().size(), 2 * nodes.size());

  const auto displacement = [](const LocalIndex i) { return 0.3 * std::sin(i); };
  for (LocalIndex i = 0; i < nodes.size(); ++i)
    {
      const double y        = nodes.position[i][0] + displacement(i);
      double       expected = 0, size = 0;
      for (std::size_t k = 0; k < faces.size(); ++k)
        {
          double q = 0;
          for (const auto &[j, value] : functions.entries()[k])
            if (j == i)
              q = value;
          const double l =
            lambda * (q * functions.double_sum() - functions.face_sums()[i] * functions.node_sums()[k]);
          const bool   is_held = faces[k].boundary == 0 || faces[k].boundary == 3;
          const double place   = faces[k].centre[0] + 0.2 * faces[k].centre[1];
          const double term =
            nodes.volume[i] * faces[k].area * l * (is_held ? chi * (place - y) : chi / (chi - 1) * y);
          expected += term;
          size += std::abs(term);
        }
      // Sums of some fifty terms.
      EXPECT_NEAR(
        force.local_element(2 * i) - transfer.springs()[2 * i] * displacement(i), expected, 1e-13 * size);
      EXPECT_EQ(force.local_element(2 * i + 1), 0.);
      EXPECT_EQ(transfer.springs()[2 * i + 1], 0.);
    }
}
