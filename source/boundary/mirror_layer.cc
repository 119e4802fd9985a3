// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/mirror_layer.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace perideal
{
  namespace
  {
    /// Angle and distance below which faces count as lying in one plane [-].
    constexpr double plane_tolerance = 1e-8;

    /// The direction a unit vector points along, or -1.
    template <int dim>
    int axis_of(const dealii::Tensor<1, dim> &normal)
    {
      for (int d = 0; d < dim; ++d)
        if (std::abs(normal[d]) > 1 - plane_tolerance)
          return d;
      return -1;
    }
  } // namespace

  template <int dim>
  MirrorLayer<dim>::MirrorLayer(const NodeCloud<dim> &real)
    : real_nodes(real)
    , n_real_nodes(real.size())
  {
  }

  template <int dim>
  MirrorLayer<dim>::MirrorLayer(const Mesh<dim>                      &mesh,
                                const NodeCloud<dim>                 &real,
                                const std::vector<BoundaryFace<dim>> &faces,
                                const Loads<dim>                     &loads)
    : MirrorLayer(real)
  {
    all = real;
    // All conditions of a boundary together make one mirror.
    std::map<dealii::types::boundary_id, std::array<int, dim>> condition_of;
    for (unsigned int k = 0; k < loads.conditions.size(); ++k)
      for (const auto id : loads.conditions[k].boundary_ids)
        for (int d = 0; d < dim; ++d)
          if (loads.conditions[k].displacement[d].is_present())
            {
              if (condition_of.count(id) == 0)
                condition_of[id].fill(-1);
              condition_of[id][d] = k;
            }
    for (const auto &entry : condition_of)
      {
        Plane plane     = make_plane(mesh, faces, entry.first);
        plane.condition = entry.second;

        const int  axis        = axis_of(plane.normal);
        const int  n_free      = std::count(plane.condition.begin(), plane.condition.end(), -1);
        const bool normal_held = axis >= 0 && plane.condition[axis] >= 0;
        if (axis < 0 && n_free > 0)
          throw InputError("the mirrored layer of a boundary that is not along the axes needs all components")
            .parameter(
              "Boundary conditions/" +
              loads.conditions[*std::max_element(plane.condition.begin(), plane.condition.end())].name)
            .hint("prescribe all components there, or take Displacement treatment = layer");
        symmetric = symmetric && ((normal_held && n_free == dim - 1) || (!normal_held && n_free == 1));
        planes.push_back(plane);
        add_images(planes.back(), planes.size() - 1);
      }
    all->number();
  }

  template <int dim>
  typename MirrorLayer<dim>::Plane
  MirrorLayer<dim>::make_plane(const Mesh<dim>                      &mesh,
                               const std::vector<BoundaryFace<dim>> &faces,
                               const dealii::types::boundary_id      boundary) const
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::min;
    using dealii::Utilities::MPI::sum;
    Plane  plane;
    double area      = 0;
    plane.boundary   = boundary;
    const double far = std::numeric_limits<double>::max();
    for (int d = 0; d < dim; ++d)
      {
        plane.lower[d] = far;
        plane.upper[d] = -far;
      }
    dealii::Tensor<1, dim> centre, normal;
    for (const BoundaryFace<dim> &face : faces)
      if (face.boundary == boundary)
        {
          area += face.area;
          centre += face.area * face.centre;
          normal += face.area * face.normal;
          for (const auto &vertex : face.vertices)
            for (int d = 0; d < dim; ++d)
              {
                plane.lower[d] = std::min(plane.lower[d], vertex[d]);
                plane.upper[d] = std::max(plane.upper[d], vertex[d]);
              }
        }
    area = sum(area, all->communicator);
    for (int d = 0; d < dim; ++d)
      {
        plane.lower[d] = min(plane.lower[d], all->communicator);
        plane.upper[d] = max(plane.upper[d], all->communicator);
      }
    plane.point = dealii::Point<dim>(sum(centre, all->communicator) / area);
    normal      = sum(normal, all->communicator);
    // The faces of a closed curve have normals that cancel.
    plane.normal = normal / std::max(normal.norm(), 1e-300);

    const double size     = plane.lower.distance(plane.upper);
    double       distance = normal.norm() < 0.1 * area ? size : 0.;
    for (const BoundaryFace<dim> &face : faces)
      if (face.boundary == boundary)
        for (const auto &vertex : face.vertices)
          distance = std::max(distance, std::abs((vertex - plane.point) * plane.normal));
    if (max(distance, all->communicator) > plane_tolerance * size)
      throw InputError("the mirrored layer needs a plane boundary, and \"" + mesh.boundary_name(boundary) +
                       "\" is curved or has several sides")
        .parameter("Boundary conditions/Displacement treatment")
        .allowed("layer | reference for this boundary")
        .hint("give each plane side its own boundary name");
    return plane;
  }

  template <int dim>
  void MirrorLayer<dim>::add_images(const Plane &plane, const unsigned int plane_number)
  {
    // Families of real nodes reach one horizon behind the plane, and the
    // families of the nodes there, whose forces count too, another one.
    double reach = 0;
    for (LocalIndex i = 0; i < all->size(); ++i)
      {
        // Horizons are spheres here.
        const double reach_of_node = all->reach(i)[0];
        if (std::abs((all->position[i] - plane.point) * plane.normal) <= reach_of_node)
          reach = std::max(reach, reach_of_node);
      }
    const double depth = 2. * dealii::Utilities::MPI::max(reach, all->communicator);

    const LocalIndex n_before = all->size();
    for (LocalIndex i = 0; i < n_before; ++i)
      {
        const double distance = (plane.point - all->position[i]) * plane.normal;
        if (distance <= 0 || distance > depth)
          continue;
        const dealii::Point<dim> foot   = all->position[i] + distance * plane.normal;
        bool                     inside = true;
        for (int d = 0; d < dim; ++d)
          // Images of images stand beside the boundary, one depth away at most.
          inside = inside && (i >= n_real_nodes || std::abs(plane.normal[d]) > 0.5 ||
                              (foot[d] >= plane.lower[d] && foot[d] <= plane.upper[d]));
        if (!inside)
          continue;
        Image image;
        image.parent        = i;
        image.source        = i < n_real_nodes ? i : images[i - n_real_nodes].source;
        image.plane         = plane_number;
        image.foot          = foot;
        const bool is_first = i < n_real_nodes;
        for (int d = 0; d < dim; ++d)
          {
            const double parent_sign = is_first ? 1. : images[i - n_real_nodes].sign[d];
            image.sign[d]            = plane.condition[d] >= 0 ? -parent_sign : parent_sign;
            // A free component passes on what holds the image it is an image of.
            image.condition[d] = plane.condition[d] >= 0 || is_first ? plane.condition[d] :
                                                                       images[i - n_real_nodes].condition[d];
          }
        images.push_back(image);
        all->position.push_back(all->position[i] + 2. * distance * plane.normal);
        all->volume.push_back(all->volume[i]);
        all->spacing.push_back(all->spacing[i]);
        if (!all->finest.empty())
          all->finest.push_back(all->finest[i]);
        if (!all->cell_radius.empty())
          all->cell_radius.push_back(all->cell_radius[i]);
        all->horizon.push_back(all->horizon[i]);
        all->material.push_back(all->material[i]);
      }
  }

  template <int dim>
  void MirrorLayer<dim>::set_time(const Loads<dim> &loads, const double time)
  {
    for (Image &image : images)
      {
        const Plane &plane = planes[image.plane];
        for (int d = 0; d < dim; ++d)
          {
            // Parents come before their images, so their offsets are known.
            const double parent_offset =
              image.parent < n_real_nodes ? 0. : images[image.parent - n_real_nodes].offset[d];
            image.offset[d] =
              plane.condition[d] < 0 ?
                parent_offset :
                2. * loads.conditions[plane.condition[d]].displacement[d].value(image.foot, time) -
                  parent_offset;
          }
      }
  }

  template <int dim>
  void MirrorLayer<dim>::extend(const NodalVector &real, const bool with_values, NodalVector &extended) const
  {
    std::copy(real.begin(), real.begin() + static_cast<std::ptrdiff_t>(dim) * n_real_nodes, extended.begin());
    for (LocalIndex k = 0; k < images.size(); ++k)
      for (int d = 0; d < dim; ++d)
        extended.local_element(dim * (n_real_nodes + k) + d) =
          images[k].sign[d] * real.local_element(dim * images[k].source + d) +
          (with_values ? images[k].offset[d] : 0.);
  }

  template <int dim>
  void MirrorLayer<dim>::boundary_values(NodalVector &values) const
  {
    values = 0.;
    for (LocalIndex k = 0; k < images.size(); ++k)
      for (int d = 0; d < dim; ++d)
        values.local_element(dim * (n_real_nodes + k) + d) = 0.5 * images[k].offset[d];
  }

  template <int dim>
  void MirrorLayer<dim>::holders(NodalVector &numbers) const
  {
    numbers = 0.;
    for (LocalIndex k = 0; k < images.size(); ++k)
      for (int d = 0; d < dim; ++d)
        numbers.local_element(dim * (n_real_nodes + k) + d) = 1 + images[k].condition[d];
  }

  PERIDEAL_INSTANTIATE_CLASS(MirrorLayer)
} // namespace perideal
