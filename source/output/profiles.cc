// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/boundary_nodes.h>
#include <perideal/output/files.h>
#include <perideal/output/gather.h>
#include <perideal/output/profiles.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  Profile<dim>::Profile(const Nodes<dim> &nodes, const std::vector<LocalIndex> &selected)
    : communicator(nodes.communicator)
    , selected(selected)
  {
    for (const LocalIndex node : selected)
      points.push_back(nodes.position[node]);
  }

  template <int dim>
  void Profile<dim>::write(const std::string &path, const std::vector<NamedField> &fields) const
  {
    const char                      *axes[] = {"x", "y", "z"};
    std::vector<std::string>         names  = header();
    std::vector<std::vector<double>> values(selected.size());
    for (const auto &[name, field] : fields)
      for (unsigned int d = 0; d < dim; ++d)
        {
          names.push_back(name + "_u_" + axes[d]);
          for (std::size_t i = 0; i < selected.size(); ++i)
            values[i].push_back(field[selected[i]][d]);
        }
    const auto table = rows(values);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      write_csv(path, names, table);
  }

  template <int dim>
  BoundaryProfile<dim>::BoundaryProfile(const Mesh<dim>                 &mesh,
                                        const Nodes<dim>                &nodes,
                                        const dealii::types::boundary_id boundary)
    : Profile<dim>(nodes, nodes_on_boundary(mesh, nodes, boundary))
    , curve(mesh, boundary)
  {
  }

  namespace
  {
    /// Owned nodes of the cells that a line passes through, touched faces included: what the planes of a
    /// cell's faces leave of the line.
    template <int dim>
    std::vector<LocalIndex> nodes_on_line(const Mesh<dim>          &mesh,
                                          const Nodes<dim>         &nodes,
                                          const dealii::Point<dim> &from,
                                          const dealii::Point<dim> &to)
    {
      std::vector<LocalIndex> result;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            double       first = 0, last = 1;
            const double round_off = 1e-9 * cell->diameter();
            for (const unsigned int f : cell->face_indices())
              {
                const auto             face   = cell->face(f);
                const auto             centre = face->center();
                dealii::Tensor<1, dim> normal;
                if constexpr (dim == 2)
                  normal = cross_product_2d(face->vertex(1) - face->vertex(0));
                else
                  normal =
                    cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
                normal /= normal.norm();
                if (normal * (centre - cell->center()) < 0)
                  normal *= -1.;
                const double outside = normal * (from - centre) - round_off, growth = normal * (to - from);
                if (growth > 0)
                  last = std::min(last, -outside / growth);
                else if (growth < 0)
                  first = std::max(first, -outside / growth);
                else if (outside > 0)
                  last = -1;
              }
            if (first < last)
              result.push_back(nodes.node_of_cell[cell->active_cell_index()]);
          }
      std::sort(result.begin(), result.end());
      return result;
    }
  } // namespace

  template <int dim>
  LineProfile<dim>::LineProfile(const Mesh<dim>          &mesh,
                                const Nodes<dim>         &nodes,
                                const dealii::Point<dim> &from,
                                const dealii::Point<dim> &to)
    : Profile<dim>(nodes, nodes_on_line(mesh, nodes, from, to))
    , from(from)
    , to(to)
  {
  }

  template <int dim>
  std::vector<std::string> LineProfile<dim>::header() const
  {
    std::vector<std::string> result = {"s [m]", "x [m]", "y [m]"};
    if (dim == 3)
      result.push_back("z [m]");
    return result;
  }

  template <int dim>
  std::vector<std::vector<double>>
  LineProfile<dim>::rows(const std::vector<std::vector<double>> &values) const
  {
    std::vector<std::vector<double>> own;
    for (std::size_t i = 0; i < values.size(); ++i)
      {
        own.push_back({(this->points[i] - from) * (to - from) / from.distance(to)});
        for (int d = 0; d < dim; ++d)
          own.back().push_back(this->points[i][d]);
        own.back().insert(own.back().end(), values[i].begin(), values[i].end());
      }
    auto result = gather(own, this->communicator);
    // Nodes side by side stand at one place but for round-off.
    const double resolution = 1e-9 * from.distance(to);
    std::sort(result.begin(), result.end(), [&](const auto &a, const auto &b) {
      if (std::abs(a[0] - b[0]) > resolution)
        return a[0] < b[0];
      return std::lexicographical_compare(
        a.begin() + 1, a.begin() + 1 + dim, b.begin() + 1, b.begin() + 1 + dim);
    });
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(Profile)
  PERIDEAL_INSTANTIATE_CLASS(BoundaryProfile)
  PERIDEAL_INSTANTIATE_CLASS(LineProfile)
} // namespace perideal
