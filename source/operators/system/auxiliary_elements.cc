// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/system/auxiliary_elements.h>

#include <deal.II/base/geometry_info.h>

namespace perideal
{
  namespace
  {
    /// A cell of the elements and the child in it, or n children for all of it.
    template <int dim>
    struct Element
    {
      typename dealii::Triangulation<dim>::cell_iterator cell;
      unsigned int                                       part;
    };

    /// The element in which a cell of the nodes' mesh lies: itself or its parent.
    template <int dim>
    Element<dim> find_element(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                              const dealii::Triangulation<dim>                         &elements)
    {
      constexpr unsigned int whole = dealii::GeometryInfo<dim>::max_children_per_cell;
      Element<dim>           result;
      if (cell->level() == 0)
        result = {elements.create_cell_iterator(cell->id()), whole};
      else
        {
          const dealii::CellId id     = cell->id();
          const unsigned int   child  = *(id.get_child_indices().end() - 1);
          const auto           parent = elements.create_cell_iterator(cell->parent()->id());
          if (parent->has_children())
            result = {parent->child(child), whole};
          else
            result = {parent, child};
        }
      AssertThrow(result.cell->is_active() && !result.cell->is_artificial(),
                  dealii::ExcMessage("the elements of this rank do not cover its cells"));
      return result;
    }
  } // namespace

  template <int dim>
  AuxiliaryElements<dim>::AuxiliaryElements(const Nodes<dim>                             &nodes,
                                            const std::shared_ptr<const ElasticFem<dim>> &fem,
                                            const SurfaceNodes<dim>                      *surface)
    : elements(fem)
    , multigrid(*fem, fem->is_on_mesh_itself() ? 1 : 2)
  {
    set_weights();
    coarse_source.reinit(fem->solution());
    coarse_solution.reinit(fem->solution());
    find_places(nodes, *fem);
    if (surface != nullptr)
      add_places(*surface, fem->mesh(), nodes);
    find_dependences(*fem);
    for (unsigned int i = 0; i < coarse_source.locally_owned_size(); ++i)
      if (fem->constraints().is_constrained(coarse_source.get_partitioner()->local_to_global(i)))
        constrained.push_back(i);
  }

  template <int dim>
  void AuxiliaryElements<dim>::set_weights()
  {
    using Geometry = dealii::GeometryInfo<dim>;
    for (unsigned int place = 0; place < n_middles; ++place)
      {
        dealii::Point<dim> middle;
        for (int d = 0; d < dim; ++d)
          middle[d] = 0.5;
        if (place > 0)
          middle[Geometry::unit_normal_direction[place - 1]] =
            Geometry::unit_normal_orientation[place - 1] > 0 ? 1. : 0.;
        for (unsigned int part = 0; part <= n_vertices; ++part)
          for (unsigned int v = 0; v < n_vertices; ++v)
            weights[part * n_middles + place][v] = Geometry::d_linear_shape_function(
              part < n_vertices ? Geometry::child_to_cell_coordinates(middle, part) : middle, v);
      }
  }

  template <int dim>
  void AuxiliaryElements<dim>::add_places(const SurfaceNodes<dim> &surface,
                                          const Mesh<dim>         &mesh,
                                          const Nodes<dim>        &nodes)
  {
    std::vector<std::vector<std::size_t>> faces_of(nodes.size());
    for (std::size_t k = 0; k < surface.faces().size(); ++k)
      faces_of[surface.cell_nodes()[k]].push_back(k);
    places.resize(surface.nodes().size());
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        {
          const LocalIndex i = nodes.node_of_cell[cell->active_cell_index()];
          for (const std::size_t k : faces_of[i])
            {
              unsigned int nearest  = 0;
              const auto   distance = [&](const unsigned int f) {
                return cell->face(f)->center().distance(surface.faces()[k].centre);
              };
              for (const unsigned int f : cell->face_indices())
                if (distance(f) < distance(nearest))
                  nearest = f;
              Place &place = places[surface.faces()[k].node];
              place        = places[i];
              place.part += 1 + nearest;
            }
        }
  }

  template <int dim>
  void AuxiliaryElements<dim>::find_places(const Nodes<dim> &nodes, const ElasticFem<dim> &fem)
  {
    const dealii::DoFHandler<dim> &unknowns    = fem.elements().unknowns;
    const auto                    &elements    = unknowns.get_triangulation();
    const auto                    &partitioner = *coarse_source.get_partitioner();
    places.resize(nodes.size());
    for (const auto &cell : fem.mesh().triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const Element<dim>                   element = find_element<dim>(cell, elements);
          const typename ElasticFem<dim>::Cell with_unknowns(
            &elements, element.cell->level(), element.cell->index(), &unknowns);
          Place &place = places[nodes.node_of_cell[cell->active_cell_index()]];
          place.part   = element.part * n_middles;
          for (const unsigned int v : with_unknowns->vertex_indices())
            place.unknowns[v] = partitioner.global_to_local(fem.elements().first_unknown(with_unknowns, v));
        }
  }

  template <int dim>
  void AuxiliaryElements<dim>::find_dependences(const ElasticFem<dim> &fem)
  {
    const auto &partitioner = *coarse_source.get_partitioner();
    for (const auto &line : fem.constraints().get_lines())
      if (partitioner.in_local_range(line.index) || partitioner.is_ghost_entry(line.index))
        for (const auto &entry : line.entries)
          dependences.push_back({partitioner.global_to_local(line.index),
                                 partitioner.global_to_local(entry.first),
                                 entry.second});
  }

  template <int dim>
  void AuxiliaryElements<dim>::restrict_to_fem(const NodalVector              &fine,
                                               const ConstrainedOperator<dim> &system) const
  {
    NodalVector &coarse = coarse_source;
    coarse              = 0.;
    double       *to    = coarse.begin();
    const double *from  = fine.begin();
    for (LocalIndex i = 0; i < places.size(); ++i)
      {
        double value[dim];
        for (int d = 0; d < dim; ++d)
          value[d] = system.is_held(dim * i + d) ? 0. : from[dim * i + d];
        const auto &weight = weights[places[i].part];
        for (unsigned int v = 0; v < n_vertices; ++v)
          for (int d = 0; d < dim; ++d)
            to[places[i].unknowns[v] + d] += weight[v] * value[d];
      }
    // On each rank's part of the sums; nothing depends on a hanging vertex.
    for (const Dependence &dependence : dependences)
      to[dependence.on] += dependence.weight * to[dependence.hanging];
    for (const Dependence &dependence : dependences)
      to[dependence.hanging] = 0.;
    coarse.compress(dealii::VectorOperation::add);
    for (const unsigned int i : constrained)
      coarse.local_element(i) = 0.;
  }

  template <int dim>
  void AuxiliaryElements<dim>::add_prolonged(NodalVector &fine, const ConstrainedOperator<dim> &system) const
  {
    NodalVector &coarse = coarse_solution;
    coarse.update_ghost_values();
    double *from = coarse.begin();
    for (const Dependence &dependence : dependences)
      from[dependence.hanging] = 0.;
    for (const Dependence &dependence : dependences)
      from[dependence.hanging] += dependence.weight * from[dependence.on];
    double *to = fine.begin();
    for (LocalIndex i = 0; i < places.size(); ++i)
      {
        double      value[dim] = {};
        const auto &weight     = weights[places[i].part];
        for (unsigned int v = 0; v < n_vertices; ++v)
          for (int d = 0; d < dim; ++d)
            value[d] += weight[v] * from[places[i].unknowns[v] + d];
        for (int d = 0; d < dim; ++d)
          if (!system.is_held(dim * i + d))
            to[dim * i + d] += value[d];
      }
    coarse.zero_out_ghost_values();
  }

  template <int dim>
  void AuxiliaryElements<dim>::add_correction(NodalVector                    &correction,
                                              const NodalVector              &residual,
                                              const ConstrainedOperator<dim> &system) const
  {
    restrict_to_fem(residual, system);
    multigrid.vmult(coarse_solution, coarse_source);
    add_prolonged(correction, system);
  }

  PERIDEAL_INSTANTIATE_CLASS(AuxiliaryElements)
} // namespace perideal
