// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/dirichlet_nodes.h>
#include <perideal/boundary/surface_nodes.h>

#include "bodies.h"
#include "testing.h"

using namespace perideal;

namespace
{
  template <int dim>
  void expect_nodes_on_held_faces()
  {
    for (const auto &mesh : test::make_boxes<dim>())
      {
        const Nodes<dim>      real(*mesh, NodeParameters{3.01});
        const auto            faces = find_boundary_faces(*mesh, real);
        BoundaryConditionText hold, pull;
        hold.name         = "hold";
        hold.boundary     = "0, 2";
        hold.displacement = {{"", "1+x+y", ""}};
        pull.name         = "pull";
        pull.boundary     = "1, 3";
        pull.traction     = {{"1", "", ""}};
        LoadParameters text;
        text.conditions = {hold, pull};
        Loads<dim> loads(text);
        loads.conditions[0].boundary_ids = {0, 2};
        loads.conditions[1].boundary_ids = {1, 3};
        const SurfaceNodes<dim> surface(real, faces, loads);
        const NodeCloud<dim>   &all = surface.nodes();

        // One for each held face, by its own rank; those of cells stay what they were.
        std::vector<BoundaryFace<dim>> held;
        for (const auto &face : faces)
          if (face.boundary == 0 || face.boundary == 2)
            held.push_back(face);
        ASSERT_EQ(all.size(), real.size() + held.size());
        EXPECT_EQ(all.n_global,
                  real.n_global + dealii::Utilities::MPI::sum<GlobalIndex>(held.size(), MPI_COMM_WORLD));
        for (LocalIndex i = 0; i < real.size(); ++i)
          EXPECT_EQ(all.position[i], real.position[i]);
        for (std::size_t k = 0; k < held.size(); ++k)
          {
            const LocalIndex node = surface.faces()[k].node;
            EXPECT_EQ(node, real.size() + k);
            EXPECT_EQ(all.position[node], held[k].centre);
            EXPECT_EQ(all.volume[node], real.volume[held[k].node]);
            EXPECT_EQ(all.horizon[node], real.horizon[held[k].node]);
          }

        // Held in the prescribed component, at the face; free in the others, as the nodes of cells are.
        const DirichletNodes<dim> on_surface(surface.faces(), loads, all.size());
        for (LocalIndex i = 0; i < all.size(); ++i)
          for (int d = 0; d < dim; ++d)
            EXPECT_EQ(on_surface.mask()[dim * i + d] != 0, i >= real.size() && d == 1);
        dealii::IndexSet owned(dim * all.n_global);
        owned.add_range(dim * all.first_global, dim * (all.first_global + all.size()));
        NodalVector values(owned, MPI_COMM_WORLD);
        on_surface.set_boundary_values(loads, 1., values);
        for (LocalIndex i = real.size(); i < all.size(); ++i)
          EXPECT_NEAR(values.local_element(dim * i + 1), 1 + all.position[i][0] + all.position[i][1], 1e-15);
      }
  }
} // namespace

TEST(SurfaceNodes, LieOnTheFacesThatConditionsHold)
{
  expect_nodes_on_held_faces<2>();
  expect_nodes_on_held_faces<3>();
}
