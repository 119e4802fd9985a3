// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_fem_fem_test_h
#define perideal_tests_unit_fem_fem_test_h

#include <perideal/fem/elastic_fem.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace perideal::test
{
  inline constexpr const char *side_names[] = {"left", "right", "bottom", "top", "front", "back"};

  inline constexpr double young_modulus = 200e9, poisson_ratio = 0.3;

  inline ElasticConstants elastic_constants(const PlaneAssumption assumption)
  {
    return {young_modulus, poisson_ratio, assumption};
  }

  /// Elasticity of a plane-strain or solid body of one material.
  template <int dim>
  SolidsByMaterial<dim> one_material()
  {
    return {{0, elastic_constants(dim == 2 ? PlaneAssumption::plane_strain : PlaneAssumption::solid)}};
  }

  /// A unit square or cube of @p n cells a side with named sides.
  template <int dim>
  void make_unit_box(Mesh<dim> &mesh, const unsigned int n)
  {
    dealii::GridGenerator::subdivided_hyper_cube(mesh.triangulation, n, 0., 1., true);
    // "Colorize" numbers the octants as materials, too.
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      cell->set_material_id(0);
    for (dealii::types::boundary_id side = 0; side < 2 * dim; ++side)
      {
        mesh.boundary_names[side_names[side]] = side;
        mesh.boundary_ids.insert(side);
      }
    mesh.material_ids.insert(0);
  }

  /// Moves the inner vertices, so that no two cells are alike nor any a parallelogram.
  template <int dim>
  void distort(Mesh<dim> &mesh)
  {
    dealii::GridTools::transform(
      [](const dealii::Point<dim> &point) {
        double bump = 0.05;
        for (unsigned int d = 0; d < dim; ++d)
          bump *= std::sin(dealii::numbers::PI * point[d]);
        dealii::Point<dim> moved = point;
        for (unsigned int d = 0; d < dim; ++d)
          moved[d] += (d == 0 ? 1. : -0.6) * bump * (0.5 + point[(d + 1) % dim]);
        return moved;
      },
      mesh.triangulation);
  }

  /// Refines the cells around one point of the inside, several levels deep.
  template <int dim>
  void refine_locally(Mesh<dim> &mesh, const unsigned int levels)
  {
    dealii::Point<dim> centre;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = 0.3;
    for (unsigned int level = 0; level < levels; ++level)
      {
        for (const auto &cell : mesh.triangulation.active_cell_iterators())
          if (cell->is_locally_owned() && cell->center().distance(centre) < 0.3)
            cell->set_refine_flag();
        mesh.triangulation.execute_coarsening_and_refinement();
      }
  }

  /// Expressions by component.
  struct Components
  {
    std::string x, y, z;
  };

  inline BoundaryConditionText displacement(const std::string &boundary, const Components &u)
  {
    BoundaryConditionText text;
    text.name         = boundary;
    text.boundary     = boundary;
    text.displacement = {{u.x, u.y, u.z}};
    return text;
  }

  inline BoundaryConditionText traction(const std::string &boundary, const Components &t)
  {
    BoundaryConditionText text;
    text.name     = boundary + " pulled";
    text.boundary = boundary;
    text.traction = {{t.x, t.y, t.z}};
    return text;
  }

  /// A number as an expression that gives it back to the last digit.
  inline std::string exact_text(const double value)
  {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
  }

  template <int dim>
  Loads<dim> make_loads(const std::vector<BoundaryConditionText> &conditions)
  {
    LoadParameters parameters;
    parameters.conditions = conditions;
    return Loads<dim>(parameters);
  }

  /// Some points all over the unit box, not symmetric, none on a cell face of the undistorted meshes.
  template <int dim>
  std::vector<dealii::Point<dim>> some_points()
  {
    std::vector<dealii::Point<dim>> points;
    for (unsigned int i = 0; i < 40; ++i)
      {
        dealii::Point<dim> point;
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = 0.02 + 0.96 * std::fmod(0.31 + 0.618034 * (i + 1) * (d + 1), 1.);
        points.push_back(point);
      }
    return points;
  }

  /// Largest difference between the solution and a function at some points, relative to the function.
  template <int dim, typename Exact>
  double relative_error(const ElasticFem<dim> &fem, const Exact &exact)
  {
    const auto points = some_points<dim>();
    const auto values = fem.evaluate(points);
    double     error = 0, largest = 0;
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        error   = std::max(error, (values[i] - exact(points[i])).norm());
        largest = std::max(largest, exact(points[i]).norm());
      }
    return error / largest;
  }
} // namespace perideal::test

#endif
