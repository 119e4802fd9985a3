// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/input_errors.h>
#include <perideal/base/instantiate.h>
#include <perideal/nodes/cell_keys.h>
#include <perideal/nodes/curve_order.h>
#include <perideal/nodes/nodes.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

namespace perideal
{
  namespace
  {
    template <typename T>
    void reorder(std::vector<T> &values, const std::vector<LocalIndex> &order)
    {
      if (values.empty())
        return;
      std::vector<T> result(values.size());
      for (std::size_t i = 0; i < order.size(); ++i)
        result[i] = values[order[i]];
      values.swap(result);
    }

    /// Jacobian in the middle of a cell, scaled to the cell's measure.
    template <int dim, typename Cell>
    dealii::Tensor<2, dim> mean_jacobian(const Cell &cell, const double measure)
    {
      dealii::Tensor<2, dim> jacobian;
      for (const unsigned int v : cell->vertex_indices())
        for (int d = 0; d < dim; ++d)
          for (int e = 0; e < dim; ++e)
            jacobian[d][e] += ((v >> e) & 1u ? 1. : -1.) * cell->vertex(v)[d] / (cell->n_vertices() / 2);
      return std::pow(measure / determinant(jacobian), 1. / dim) * jacobian;
    }

    /// Longest over shortest edge of the parallelepiped that a Jacobian spans.
    template <int dim>
    double aspect_ratio(const dealii::Tensor<2, dim> &jacobian)
    {
      const auto edges    = transpose(jacobian);
      double     shortest = edges[0].norm(), longest = shortest;
      for (int d = 1; d < dim; ++d)
        {
          shortest = std::min(shortest, edges[d].norm());
          longest  = std::max(longest, edges[d].norm());
        }
      return longest / shortest;
    }
  } // namespace

  void NodeParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Nodes");
    prm.add_parameter("Horizon factor",
                      horizon_factor,
                      "Horizon of a node over its spacing, the edge of the square or cube of its volume; "
                      "1.01 to 20 [-]; the consistent form of linear statics takes 2.01",
                      dealii::Patterns::Double());
    prm.add_parameter("Horizon shape",
                      horizon_shape,
                      "sphere; or cell: an ellipsoid with as many cells along each of its axes, for cells "
                      "that are long in one direction (consistent form only); automatic: cell for the "
                      "consistent form where the mean aspect ratio of the cells is above 3, else sphere");
    prm.add_parameter(
      "Share equal families",
      share_equal_families,
      "Whether families that are identical but for rounding, as in structured parts of a mesh, "
      "are weighed once and share their weights, where many are, and cells of the consistent form "
      "their polynomials and faces; false: each has its own, for comparisons of time and memory");
    prm.add_parameter(
      "Families on demand",
      families_on_demand,
      "Whether the consistent form, where something can break, makes whole families of the "
      "nodes only that a crack comes near; false: of all at the beginning, for comparisons of "
      "time and memory");
    prm.add_parameter(
      "Perturbation",
      perturbation,
      "Random cloud of points: how far nodes lie off the centroids of their cells, whose volumes "
      "they keep, along each edge by this share of it times a uniform number from -1/2 to 1/2, the "
      "same for any number of ranks; for studies, 0 to 0.5 [-]",
      dealii::Patterns::Double());
    prm.leave_subsection();
  }

  void NodeParameters::check() const
  {
    InputErrorCollector errors;
    // Below one spacing a node of a uniform mesh reaches no neighbour at all.
    if (!(horizon_factor >= 1.01 && horizon_factor <= 20))
      errors.add(InputError("this horizon factor gives no usable families")
                   .parameter("Nodes/Horizon factor")
                   .allowed("1.01 to 20; 3.01 is usual"));
    // A convex quadrilateral of any shape keeps its node up to 2/3; the thinnest, a triangle, not beyond.
    if (!(perturbation >= 0 && perturbation <= 0.5))
      errors.add(InputError("nodes must stay within their cells, whatever the shape of these")
                   .parameter("Nodes/Perturbation")
                   .allowed("0 to 0.5, which moves nodes by up to a quarter of an edge"));
    errors.raise();
  }

  template <int dim>
  dealii::Tensor<1, dim> NodeArrays<dim>::reach(const LocalIndex i) const
  {
    dealii::Tensor<1, dim> result;
    if (shape.empty())
      for (int d = 0; d < dim; ++d)
        // |xi| < horizon_i + radius_j <= (1 + margin) max(horizon_i, horizon_j).
        result[d] = (1. + round_off + margin) * horizon[i];
    else
      {
        Assert(margin == 0, dealii::ExcNotImplemented());
        // The box around the image of the unit sphere under the inverse map.
        const auto semi_axes = invert(shape[i]);
        for (int d = 0; d < dim; ++d)
          result[d] = semi_axes[d].norm();
      }
    return result;
  }

  template <int dim>
  void NodeCloud<dim>::set_cell_radius(std::vector<double> radius)
  {
    Assert(radius.size() == size() && shape.empty(), dealii::ExcInternalError());
    cell_radius = std::move(radius);
    margin      = 0;
    for (LocalIndex i = 0; i < size(); ++i)
      margin = std::max(margin, cell_radius[i] / horizon[i]);
    margin = dealii::Utilities::MPI::max(margin, communicator);
  }

  template <int dim>
  void NodeCloud<dim>::number()
  {
    const GlobalIndex n_owned = position.size();
    first_global              = 0;
    const int error           = MPI_Exscan(&n_owned, &first_global, 1, MPI_UINT64_T, MPI_SUM, communicator);
    AssertThrowMPI(error);
    n_global = dealii::Utilities::MPI::sum(n_owned, communicator);
  }

  template <int dim>
  Nodes<dim>::Nodes(const Mesh<dim> &mesh, const NodeParameters &parameters)
    : node_of_cell(mesh.triangulation.n_active_cells(), dealii::numbers::invalid_unsigned_int)
  {
    auto &position = this->position;
    auto &volume   = this->volume;
    auto &material = this->material;

    parameters.check();
    this->communicator       = mesh.triangulation.get_communicator();
    const LocalIndex n_owned = mesh.triangulation.n_locally_owned_active_cells();
    position.reserve(n_owned);
    volume.reserve(n_owned);
    material.reserve(n_owned);
    std::vector<unsigned int> cells;

    // Two Gauss points integrate measure and first moment of a bilinear or
    // trilinear cell exactly; the mean of the vertices is not the centroid.
    const dealii::MappingQ1<dim>  mapping;
    const dealii::FE_Nothing<dim> no_element;
    const dealii::QGauss<dim>     quadrature(2);
    dealii::FEValues<dim>         values(
      mapping, no_element, quadrature, dealii::update_JxW_values | dealii::update_quadrature_points);
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          double             measure = 0;
          dealii::Point<dim> moment;
          for (const unsigned int q : values.quadrature_point_indices())
            {
              measure += values.JxW(q);
              moment += values.JxW(q) * values.quadrature_point(q);
            }
          position.push_back(moment / measure);
          volume.push_back(measure);
          material.push_back(cell->material_id());
          cells.push_back(cell->active_cell_index());
        }

    choose_shape(mesh, parameters);
    const auto order = order_along_curve(position);
    reorder(this->shape, order);
    reorder(position, order);
    reorder(volume, order);
    reorder(material, order);
    reorder(cells, order);
    for (LocalIndex i = 0; i < n_owned; ++i)
      {
        node_of_cell[cells[i]] = i;
        this->spacing.push_back(std::pow(volume[i], 1. / dim));
        this->horizon.push_back(parameters.horizon_factor * this->spacing[i]);
        volume[i] *= mesh.thickness;
      }

    this->number();
    if (parameters.perturbation > 0)
      perturb(mesh, parameters.perturbation);
  }

  template <int dim>
  void Nodes<dim>::perturb(const Mesh<dim> &mesh, const double eta)
  {
    const auto keys = cell_keys(mesh, *this);
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const LocalIndex       i     = node_of_cell[cell->active_cell_index()];
          const auto             edges = mean_jacobian<dim>(cell, std::pow(this->spacing[i], dim));
          std::mt19937_64        random(keys[i]);
          dealii::Tensor<1, dim> share;
          for (int d = 0; d < dim; ++d)
            share[d] = eta * (std::generate_canonical<double, 53>(random) - 0.5);
          this->position[i] += edges * share;
        }
  }

  template <int dim>
  void Nodes<dim>::choose_shape(const Mesh<dim> &mesh, const NodeParameters &parameters)
  {
    double aspect_ratios = 0;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto jacobian = mean_jacobian<dim>(cell, this->volume[this->shape.size()]);
          aspect_ratios += aspect_ratio(jacobian);
          max_aspect_ratio = std::max(max_aspect_ratio, aspect_ratio(jacobian));
          this->shape.push_back(invert(jacobian) / parameters.horizon_factor);
        }
    const auto &all   = this->communicator;
    max_aspect_ratio  = dealii::Utilities::MPI::max(max_aspect_ratio, all);
    mean_aspect_ratio = dealii::Utilities::MPI::sum(aspect_ratios, all) /
                        dealii::Utilities::MPI::sum(static_cast<double>(this->shape.size()), all);
    // On stretched cells spheres reach across many cells one way and none the other.
    if (parameters.horizon_shape == HorizonShape::sphere ||
        (parameters.horizon_shape == HorizonShape::automatic && mean_aspect_ratio <= 3.))
      this->shape.clear();
  }

  template <int dim>
  std::vector<double> Nodes<dim>::cell_radii(const Mesh<dim> &mesh) const
  {
    std::vector<double> result(this->size());
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const LocalIndex i = node_of_cell[cell->active_cell_index()];
          for (const unsigned int v : cell->vertex_indices())
            result[i] = std::max(result[i], this->position[i].distance(cell->vertex(v)));
        }
    return result;
  }

  template <int dim>
  void Nodes<dim>::keep_cells(const Mesh<dim> &mesh)
  {
    this->has_cells = true;
    this->cell.resize(this->size());
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          this->cell[node_of_cell[cell->active_cell_index()]][v] = cell->vertex(v);
    this->set_cell_radius(cell_radii(mesh));
  }

  PERIDEAL_INSTANTIATE_CLASS(NodeArrays)
  PERIDEAL_INSTANTIATE_CLASS(NodeCloud)
  PERIDEAL_INSTANTIATE_CLASS(Nodes)
} // namespace perideal
