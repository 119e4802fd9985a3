// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_bodies_h
#define perideal_tests_unit_bodies_h

#include <perideal/mesh/mesh.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/nodes/nodes.h>
#include <perideal/quadrature/bond_volume.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>
#include <iomanip>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

/// Small bodies that several rooms are tested on.
namespace perideal::test
{
  /// A number in [-1, 1) without pattern that depends on a position alone, and
  /// so not on the number of ranks.
  template <int dim>
  double scatter(const dealii::Point<dim> &point, const unsigned int seed)
  {
    double phase = 78.233 * seed;
    for (int d = 0; d < dim; ++d)
      phase += (12.9898 + 7.1 * d) * point[d];
    const double value = 43758.5453 * std::sin(phase);
    return 2 * (value - std::floor(value)) - 1;
  }

  /// A number as a formula, with all its digits.
  inline std::string formula(const double value)
  {
    std::ostringstream text;
    text << std::scientific << std::setprecision(17) << "(" << value << ")";
    return text.str();
  }

  /// A component of the linear field of a gradient as a formula of the place.
  template <int dim>
  std::string formula(const dealii::Tensor<2, dim> &gradient, const unsigned int component)
  {
    const char *const axes[] = {"x", "y", "z"};
    std::string       text;
    for (int d = 0; d < dim; ++d)
      text += (d == 0 ? "" : " + ") + formula(gradient[component][d]) + "*" + axes[d];
    return text;
  }

  /// A box of cells with corner at the origin, its inner vertices moved by up
  /// to @p distortion cell sizes. Boundaries are numbered as
  /// GridGenerator::hyper_rectangle colours them.
  template <int dim>
  std::unique_ptr<Mesh<dim>> make_box(const std::vector<unsigned int> &cells,
                                      const dealii::Point<dim>        &size,
                                      const double                     distortion,
                                      MPI_Comm                         communicator = MPI_COMM_WORLD)
  {
    auto mesh = std::make_unique<Mesh<dim>>(communicator);
    dealii::GridGenerator::subdivided_hyper_rectangle(
      mesh->triangulation, cells, dealii::Point<dim>(), size, true);
    dealii::GridTools::transform(
      [&](const dealii::Point<dim> &vertex) {
        dealii::Point<dim> moved  = vertex;
        bool               inside = true;
        for (int d = 0; d < dim; ++d)
          inside = inside && vertex[d] > 1e-9 * size[d] && vertex[d] < (1 - 1e-9) * size[d];
        if (inside)
          for (int d = 0; d < dim; ++d)
            moved[d] += distortion * size[d] / cells[d] * scatter(vertex, d);
        return moved;
      },
      mesh->triangulation);
    for (const auto id : mesh->triangulation.get_boundary_ids())
      mesh->boundary_ids.insert(id);
    // The generator colours the octants as materials.
    for (const auto &cell : mesh->triangulation.cell_iterators())
      cell->set_material_id(0);
    mesh->material_ids.insert(0);
    return mesh;
  }

  /// As make_box(), with the cells within @p radius of a point refined once: faces hang.
  template <int dim>
  std::unique_ptr<Mesh<dim>> make_refined_box(const std::vector<unsigned int> &cells,
                                              const dealii::Point<dim>        &point,
                                              const double                     radius,
                                              MPI_Comm                         communicator = MPI_COMM_WORLD)
  {
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = 1.;
    auto mesh = make_box<dim>(cells, size, 0.2, communicator);
    for (const auto &cell : mesh->triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->center().distance(point) < radius)
        cell->set_refine_flag();
    mesh->triangulation.execute_coarsening_and_refinement();
    return mesh;
  }

  /// Boxes of every kind the families meet: regular, distorted, thin, with hanging faces.
  template <int dim>
  std::vector<std::unique_ptr<Mesh<dim>>> make_boxes(MPI_Comm communicator = MPI_COMM_WORLD)
  {
    std::vector<std::unique_ptr<Mesh<dim>>> result;
    if constexpr (dim == 2)
      {
        result.push_back(make_box<2>({7, 6}, {1., 0.9}, 0., communicator));
        result.push_back(make_box<2>({8, 7}, {1., 1.}, 0.3, communicator));
        result.push_back(make_box<2>({12, 4}, {2., 0.5}, 0.2, communicator));
        result.push_back(make_refined_box<2>({6, 5}, {0.4, 0.5}, 0.3, communicator));
      }
    else
      {
        result.push_back(make_box<3>({5, 5, 5}, {1., 1., 1.}, 0., communicator));
        result.push_back(make_box<3>({5, 5, 4}, {1., 1., 0.8}, 0.25, communicator));
        result.push_back(make_refined_box<3>({4, 4, 4}, {0.4, 0.4, 0.4}, 0.25, communicator));
      }
    return result;
  }

  /// Nodes and families of a mesh.
  template <int dim>
  struct Body
  {
    explicit Body(const Mesh<dim>   &mesh,
                  const double       horizon_factor = 3.01,
                  const std::string &horizon_shape  = "sphere",
                  const std::string &scheme         = "one point")
      : nodes(mesh, NodeParameters{horizon_factor, choice_of<HorizonShape>(horizon_shape)})
    {
      QuadratureParameters quadrature;
      quadrature.scheme = choice_of<QuadratureScheme>(scheme);
      prepare_cells(quadrature, mesh, nodes);
      families = std::make_shared<const Families<dim>>(nodes, create_volume_rule<dim>(quadrature));
    }

    Nodes<dim>                           nodes;
    std::shared_ptr<const Families<dim>> families;
  };
} // namespace perideal::test

#endif
