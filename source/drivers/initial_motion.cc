// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/drivers/initial_motion.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    template <int dim>
    std::array<SpaceTimeFunction<dim>, dim> read_initial(const std::array<std::string, 3> &formulas,
                                                         const std::string                &prefix)
    {
      if (dim == 2 && !formulas[2].empty())
        throw InputError("a two-dimensional scene has no z component").parameter(prefix + "z");
      const char                             *axes[] = {"x", "y", "z"};
      std::array<SpaceTimeFunction<dim>, dim> result;
      for (int d = 0; d < dim; ++d)
        result[d] = SpaceTimeFunction<dim>(formulas[d], prefix + axes[d]);
      return result;
    }

    /// Writes the means over the cells of what is given at t = 0.
    template <int dim>
    void set_means(const std::array<SpaceTimeFunction<dim>, dim> &functions,
                   const Mesh<dim>                               &mesh,
                   const Nodes<dim>                              &nodes,
                   NodalVector                                   &field)
    {
      const dealii::FE_Nothing<dim> no_shape;
      dealii::FEValues<dim>         values(
        no_shape, dealii::QGauss<dim>(3), dealii::update_quadrature_points | dealii::update_JxW_values);
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            values.reinit(cell);
            const LocalIndex i = nodes.node_of_cell[cell->active_cell_index()];
            for (int d = 0; d < dim; ++d)
              if (functions[d].is_present())
                {
                  double sum = 0, volume = 0;
                  for (const unsigned int q : values.quadrature_point_indices())
                    {
                      sum += values.JxW(q) * functions[d].value(values.quadrature_point(q), 0.);
                      volume += values.JxW(q);
                    }
                  field.local_element(dim * i + d) = sum / volume;
                }
          }
    }
  } // namespace

  template <int dim>
  InitialMotion<dim>::InitialMotion(const InitialParameters &parameters)
    : displacement(read_initial<dim>(parameters.displacement, "Initial conditions/u_"))
    , velocity(read_initial<dim>(parameters.velocity, "Initial conditions/v_"))
  {
  }

  template <int dim>
  bool InitialMotion<dim>::displaces() const
  {
    return std::any_of(
      displacement.begin(), displacement.end(), [](const auto &component) { return component.is_present(); });
  }

  template <int dim>
  void InitialMotion<dim>::set(const Problem<dim> &problem, ExplicitDynamics<dim> &dynamics) const
  {
    const Nodes<dim> &nodes = *problem.body.nodes;
    for (int d = 0; d < dim; ++d)
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        {
          if (velocity[d].is_present())
            dynamics.velocity.local_element(dim * i + d) = velocity[d].value(nodes.position[i], 0.);
          if (displacement[d].is_present())
            dynamics.displacement.local_element(dim * i + d) = displacement[d].value(nodes.position[i], 0.);
        }
    if (!displaces())
      return;
    // The unknowns of the consistent form are means.
    if (problem.parameters.model.is_consistent())
      set_means<dim>(displacement, *problem.body.mesh, nodes, dynamics.displacement);
    hold(problem, dynamics.displacement);
  }

  template <int dim>
  void InitialMotion<dim>::hold(const Problem<dim> &problem, NodalVector &field) const
  {
    const auto &conditions = problem.loading.loads.conditions;
    const auto &entries    = problem.loading.supports->held().entries();
    const auto  position   = [&](const auto &entry) -> const SpaceTimeFunction<dim>  &{
      return conditions[entry.condition].displacement[entry.component];
    };
    for (const auto &entry : entries)
      if (position(entry).is_present())
        field.local_element(dim * entry.node + entry.component) = 0.;
    for (const auto &entry : entries)
      if (position(entry).is_present())
        field.local_element(dim * entry.node + entry.component) +=
          entry.share * position(entry).value(entry.point, 0.);
  }

  template <int dim>
  void InitialMotion<dim>::move_supports(const Problem<dim>    &problem,
                                         const bool             mesh_has_changed,
                                         ExplicitDynamics<dim> &dynamics) const
  {
    if (!problem.loading.supports->hold_nodes())
      move_faces(problem, *problem.loading.supports->face_values(), dynamics);
    else if (mesh_has_changed)
      {
        NodalVector start(dynamics.displacement.get_partitioner());
        for (const auto &entry : problem.loading.supports->held().entries())
          if (const auto &function = displacement[entry.component]; function.is_present())
            start.local_element(dim * entry.node + entry.component) = function.value(entry.point, 0.);
        if (displaces())
          hold(problem, start);
        dynamics.move_held_nodes(start);
      }
  }

  template <int dim>
  void InitialMotion<dim>::move_faces(const Problem<dim>    &problem,
                                      FaceValues<dim>       &values,
                                      ExplicitDynamics<dim> &dynamics) const
  {
    std::vector<dealii::Tensor<1, dim>> start(values.entries().size());
    for (std::size_t e = 0; e < start.size() && displaces(); ++e)
      for (int d = 0; d < dim; ++d)
        {
          const auto &entry = values.entries()[e];
          if (entry.condition[d] == FaceValues<dim>::free)
            continue;
          const auto &held = problem.loading.loads.conditions[entry.condition[d]].displacement[d];
          if (const auto &function = held.is_present() ? held : displacement[d]; function.is_present())
            start[e][d] = function.value(entry.position, 0.);
        }
    dynamics.move_faces(values, start);
  }

  PERIDEAL_INSTANTIATE_CLASS(InitialMotion)
} // namespace perideal
