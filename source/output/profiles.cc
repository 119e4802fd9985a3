// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/nodes/boundary_nodes.h>
#include <perideal/output/files.h>
#include <perideal/output/profiles.h>

#include <deal.II/base/mpi.h>

namespace perideal
{
  template <int dim>
  BoundaryProfile<dim>::BoundaryProfile(const Mesh<dim>                 &mesh,
                                        const Nodes<dim>                &nodes,
                                        const dealii::types::boundary_id boundary)
    : communicator(nodes.communicator)
    , curve(mesh, boundary)
    , selected(nodes_on_boundary(mesh, nodes, boundary))
  {
    for (const LocalIndex node : selected)
      points.push_back(nodes.position[node]);
  }

  template <int dim>
  void BoundaryProfile<dim>::write(const std::string &path, const std::vector<NamedField> &fields) const
  {
    const char                      *axes[] = {"x", "y", "z"};
    std::vector<std::string>         header = curve.header();
    std::vector<std::vector<double>> values(selected.size());
    for (const auto &[name, field] : fields)
      for (unsigned int d = 0; d < dim; ++d)
        {
          header.push_back(name + "_u_" + axes[d]);
          for (std::size_t i = 0; i < selected.size(); ++i)
            values[i].push_back(field[selected[i]][d]);
        }
    const auto rows = curve.rows(points, values);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      write_csv(path, header, rows);
  }

  template class BoundaryProfile<2>;
  template class BoundaryProfile<3>;
} // namespace perideal
