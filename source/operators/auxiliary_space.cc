// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/auxiliary_space.h>
#include <perideal/operators/largest_eigenvalue.h>

#include <deal.II/base/geometry_info.h>

namespace perideal
{
  template <int dim>
  AuxiliarySpace<dim>::AuxiliarySpace(const ConstrainedOperator<dim> &system,
                                      const Nodes<dim>               &nodes,
                                      const ElasticFem<dim>          &fem)
    : system(system)
    , smoother(system)
    , multigrid(fem, false)
    , vertex_unknowns(nodes.size())
  {
    // A little more than 1: the best of 0.7 to 2 on plates of 2,000 to 120,000 cells.
    smoother.set_damping(1.3 / estimate_largest_eigenvalue(system, smoother));

    coarse_source.reinit(fem.solution());
    coarse_solution.reinit(fem.solution());
    const auto &partitioner = *coarse_source.get_partitioner();
    for (const auto &cell : fem.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          auto &unknowns = vertex_unknowns[nodes.node_of_cell[cell->active_cell_index()]];
          for (const unsigned int v : cell->vertex_indices())
            {
              const auto first = cell->vertex_dof_index(v, 0);
              Assert(cell->vertex_dof_index(v, dim - 1) == first + dim - 1, dealii::ExcInternalError());
              unknowns[v] = partitioner.global_to_local(first);
            }
        }
    for (unsigned int i = 0; i < coarse_source.locally_owned_size(); ++i)
      if (fem.constraints().is_constrained(partitioner.local_to_global(i)))
        constrained.push_back(i);
  }

  template <int dim>
  void AuxiliarySpace<dim>::restrict_to_fem(NodalVector &coarse, const NodalVector &fine) const
  {
    coarse             = 0.;
    double       *to   = coarse.begin();
    const double *from = fine.begin();
    for (LocalIndex i = 0; i < vertex_unknowns.size(); ++i)
      {
        double value[dim];
        for (int d = 0; d < dim; ++d)
          value[d] = system.is_held(dim * i + d) ? 0. : from[dim * i + d] / n_vertices;
        for (const unsigned int unknown : vertex_unknowns[i])
          for (int d = 0; d < dim; ++d)
            to[unknown + d] += value[d];
      }
    coarse.compress(dealii::VectorOperation::add);
    for (const unsigned int i : constrained)
      coarse.local_element(i) = 0.;
  }

  template <int dim>
  void AuxiliarySpace<dim>::add_prolonged(NodalVector &fine, const NodalVector &coarse) const
  {
    coarse.update_ghost_values();
    const double *from = coarse.begin();
    double       *to   = fine.begin();
    for (LocalIndex i = 0; i < vertex_unknowns.size(); ++i)
      {
        double value[dim] = {};
        for (const unsigned int unknown : vertex_unknowns[i])
          for (int d = 0; d < dim; ++d)
            value[d] += from[unknown + d];
        for (int d = 0; d < dim; ++d)
          if (!system.is_held(dim * i + d))
            to[dim * i + d] += value[d] / n_vertices;
      }
    coarse.zero_out_ghost_values();
  }

  template <int dim>
  void AuxiliarySpace<dim>::vmult(NodalVector &destination, const NodalVector &source) const
  {
    smoother.vmult(destination, source);
    restrict_to_fem(coarse_source, source);
    multigrid.vmult(coarse_solution, coarse_source);
    add_prolonged(destination, coarse_solution);
  }

  template class AuxiliarySpace<2>;
  template class AuxiliarySpace<3>;
} // namespace perideal
