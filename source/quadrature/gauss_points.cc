// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/quadrature/bond_volume.h>
#include <perideal/quadrature/gauss_points.h>
#include <perideal/quadrature/moving_least_squares.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace perideal
{
  template <int dim>
  GaussPoints<dim>::GaussPoints(const Mesh<dim>     &mesh,
                                const Nodes<dim>    &nodes,
                                const Families<dim> &families,
                                const unsigned int   n)
    : n_of_cell(dealii::Utilities::pow(n, dim))
    , n_owned(families.n_owned())
  {
    coordinates.reinit(families.make_partitioner(dim * n_of_cell));
    volumes.reinit(families.make_partitioner(n_of_cell));
    widths.reinit(families.make_partitioner(n_of_cell));
    place_points(mesh, nodes, n);
  }

  template <int dim>
  void GaussPoints<dim>::place_points(const Mesh<dim> &mesh, const Nodes<dim> &nodes, const unsigned int n)
  {
    const dealii::MappingQ1<dim>  mapping;
    const dealii::FE_Nothing<dim> no_element;
    const dealii::QGauss<dim>     gauss(n);
    dealii::FEValues<dim>         values(
      mapping, no_element, gauss, dealii::update_JxW_values | dealii::update_quadrature_points);
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          const LocalIndex j = nodes.node_of_cell[cell->active_cell_index()];
          for (unsigned int g = 0; g < n_of_cell; ++g)
            {
              for (int d = 0; d < dim; ++d)
                coordinates.local_element((dim * j + d) * n_of_cell + g) = values.quadrature_point(g)[d];
              volumes.local_element(j * n_of_cell + g) = values.JxW(g) * mesh.thickness;
              widths.local_element(j * n_of_cell + g)  = std::pow(values.JxW(g), 1. / dim);
            }
        }
    for (NodalVector *field : {&coordinates, &volumes, &widths})
      field->update_ghost_values();
  }

  template <int dim>
  void GaussPoints<dim>::fit(const Nodes<dim> &nodes, const double support_radius)
  {
    // Who lies near enough is found as families are, with supports for horizons.
    NodeCloud<dim> cloud = nodes;
    cloud.margin         = 0;
    cloud.cell_radius.clear();
    cloud.shape.clear();
    for (LocalIndex j = 0; j < n_owned; ++j)
      {
        double farthest = 0;
        for (unsigned int g = 0; g < n_of_cell; ++g)
          {
            dealii::Point<dim> x;
            for (int d = 0; d < dim; ++d)
              x[d] = coordinate(j, d)[g];
            farthest = std::max(farthest, x.distance(nodes.position[j]));
          }
        cloud.horizon[j] = support_radius * nodes.spacing[j] + farthest;
      }
    const Families<dim> around(cloud);
    ghosted.reinit(around.make_partitioner(dim));
    for (LocalIndex i = 0; i < around.n_local(); ++i)
      global_number.push_back(around.global_number(i));

    MovingLeastSquares<dim>         least_squares;
    std::vector<dealii::Point<dim>> positions;
    std::vector<LocalIndex>         candidates;
    std::vector<double>             of_cell;
    std::string                     problem;
    first.assign(1, 0);
    for (LocalIndex j = 0; j < n_owned && problem.empty(); ++j)
      {
        candidates.assign(1, j);
        candidates.insert(candidates.end(), around.begin(j), around.end(j));
        positions.clear();
        for (const LocalIndex k : candidates)
          positions.push_back(around.position[k]);
        of_cell.assign(candidates.size() * n_of_cell, 0.);
        for (unsigned int g = 0; g < n_of_cell && problem.empty(); ++g)
          {
            dealii::Point<dim> x;
            for (int d = 0; d < dim; ++d)
              x[d] = coordinate(j, d)[g];
            if (!least_squares.reinit(x, positions, support_radius * nodes.spacing[j]))
              {
                std::ostringstream text;
                text << "at (" << x << "): " << least_squares.problem();
                problem = text.str();
              }
            for (std::size_t k = 0; k < candidates.size() && problem.empty(); ++k)
              of_cell[k * n_of_cell + g] = least_squares.weights()[k];
          }
        for (std::size_t k = 0; k < candidates.size(); ++k)
          if (const auto begin = of_cell.begin() + k * n_of_cell;
              std::any_of(begin, begin + n_of_cell, [](const double w) { return w != 0; }))
            {
              column.push_back(candidates[k]);
              weight.insert(weight.end(), begin, begin + n_of_cell);
            }
        first.push_back(column.size());
      }
    for (const std::string &text : dealii::Utilities::MPI::all_gather(nodes.communicator, problem))
      if (!text.empty())
        throw InputError("the nodes around a Gauss point are too few for its displacement, " + text)
          .parameter("Quadrature/Support radius")
          .hint("enlarge it; a quadratic fit needs three cells or more across the body in each direction");
  }

  template <int dim>
  void GaussPoints<dim>::interpolate(const NodalVector &displacement, NodalVector &at_points) const
  {
    std::copy(displacement.begin(), displacement.begin() + dim * n_owned, ghosted.begin());
    ghosted.update_ghost_values();
    for (LocalIndex j = 0; j < n_owned; ++j)
      {
        double *values = at_points.begin() + std::size_t(dim) * j * n_of_cell;
        std::fill(values, values + dim * n_of_cell, 0.);
        for (BondIndex m = first[j]; m < first[j + 1]; ++m)
          {
            const double *u = ghosted.begin() + dim * column[m];
            const double *w = weight.data() + m * n_of_cell;
            for (int d = 0; d < dim; ++d)
              for (unsigned int g = 0; g < n_of_cell; ++g)
                values[d * n_of_cell + g] += w[g] * u[d];
          }
      }
    ghosted.zero_out_ghost_values();
    at_points.update_ghost_values();
  }

  template <int dim>
  std::vector<GlobalIndex> GaussPoints<dim>::support(const LocalIndex j) const
  {
    std::vector<GlobalIndex> result;
    for (BondIndex m = first[j]; m < first[j + 1]; ++m)
      result.push_back(global_number[column[m]]);
    return result;
  }

  template <int dim>
  std::size_t GaussPoints<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return coordinates.memory_consumption() + volumes.memory_consumption() + widths.memory_consumption() +
           ghosted.memory_consumption() + memory_consumption(first) + memory_consumption(column) +
           memory_consumption(global_number) + memory_consumption(weight);
  }

  template <int dim>
  double first_moment(const Families<dim> &families, const GaussPoints<dim> &points, const LocalIndex i)
  {
    double result = 0;
    visit_cells(families, i, [&](const LocalIndex j) {
      for (unsigned int g = 0; g < points.n_points(); ++g)
        {
          dealii::Tensor<1, dim> bond;
          for (int d = 0; d < dim; ++d)
            bond[d] = points.coordinate(j, d)[g] - families.position[i][d];
          const double length = bond.norm();
          result +=
            linear_share(families.horizon[i], points.width(j)[g], length) * points.volume(j)[g] * length;
        }
    });
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(GaussPoints)
  template double first_moment(const Families<2> &, const GaussPoints<2> &, const LocalIndex);
  template double first_moment(const Families<3> &, const GaussPoints<3> &, const LocalIndex);
} // namespace perideal
