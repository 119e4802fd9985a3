// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/mesh/point_location.h>
#include <perideal/output/files.h>
#include <perideal/problem/output_fields.h>
#include <perideal/recorders/line_values.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/mapping_q1.h>

namespace perideal
{
  template <int dim>
  LineValues<dim>::LineValues(const Problem<dim> &problem, const std::vector<Line> &lines)
    : problem(problem)
    , lines(lines)
  {
    std::vector<Place>              all;
    std::vector<dealii::Point<dim>> points;
    for (std::size_t l = 0; l < lines.size(); ++l)
      for (unsigned int k = 0; k < lines[l].n_points; ++k)
        {
          const auto step =
            (lines[l].to - lines[l].from) * (static_cast<double>(k) / (lines[l].n_points - 1));
          points.push_back(lines[l].from + step);
          all.push_back({l, step.norm(), points.back()});
        }
    std::vector<double>          distances;
    const dealii::MappingQ1<dim> mapping;
    PointLocation<dim>(problem.body.mesh->triangulation, mapping).share(points, distances);
    std::vector<typename PointValues<dim>::NamedPoint> inside;
    for (std::size_t p = 0; p < all.size(); ++p)
      if (distances[p] <= PointLocation<dim>::still_near)
        {
          places.push_back(all[p]);
          inside.push_back({"Comparison/" + lines[all[p].line].name, all[p].point});
        }
    values = std::make_unique<PointValues<dim>>(problem, inside);
  }

  template <int dim>
  void LineValues<dim>::write(const std::string &directory)
  {
    std::vector<std::string> header = {"s [m]", "x [m]", "y [m]"};
    if (dim == 3)
      header.push_back("z [m]");
    std::vector<std::vector<double>> columns;
    const auto                       take = [&](const std::string &unit) {
      for (const auto &column : values->take())
        {
          header.push_back(column.name + " [" + unit + "]");
          columns.push_back(column.values);
        }
    };
    for (const char *const field : {"displacement", "strain", "stress"})
      {
        add_output_fields(problem, {field}, *values);
        take(output_field_unit(field));
      }
    if (const auto &fem = problem.state.fem)
      {
        values->add_vector("fem_displacement", fem->displacement);
        take("m");
        std::vector<dealii::SymmetricTensor<2, 3>> strain, stress;
        for (const ElasticState &state : fem->states.value_or(std::vector<ElasticState>()))
          {
            strain.push_back(state.strain);
            stress.push_back(state.stress);
          }
        if (fem->states)
          {
            values->add_tensor("fem_strain", strain);
            take("-");
            values->add_tensor("fem_stress", stress);
            take("Pa");
          }
      }
    std::vector<std::vector<std::vector<double>>> rows(lines.size());
    for (std::size_t p = 0; p < places.size(); ++p)
      {
        std::vector<double> row = {places[p].distance};
        for (int d = 0; d < dim; ++d)
          row.push_back(places[p].point[d]);
        for (const auto &column : columns)
          row.push_back(column[p]);
        rows[places[p].line].push_back(row);
      }
    write_together(problem.run.communicator, [&] {
      if (dealii::Utilities::MPI::this_mpi_process(problem.run.communicator) == 0)
        for (std::size_t l = 0; l < lines.size(); ++l)
          write_csv(directory + "/line_" + lines[l].name + ".csv", header, rows[l]);
    });
  }

  PERIDEAL_INSTANTIATE_CLASS(LineValues)
} // namespace perideal
