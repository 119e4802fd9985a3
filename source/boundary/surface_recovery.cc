// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/surface_recovery.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace perideal
{
  namespace
  {
    /// The conditions of the face itself hold exactly for all practical purposes;
    /// those of the neighbours count like the displacements near by.
    constexpr double own_face_weight = 100., other_face_weight = 1., equilibrium_weight = 1.;
  } // namespace

  template <int dim>
  SurfaceRecovery<dim>::SurfaceRecovery(const Mesh<dim>             &mesh,
                                        const CellGraph<dim>        &graph,
                                        const SolidsByMaterial<dim> &solids,
                                        const Loads<dim>            &loads,
                                        const Held                   held)
    : mesh(mesh)
    , graph(graph)
    , solids(solids)
    , loads(loads)
    , held(held)
    , faces(find_boundary_faces(mesh, graph))
  {
    std::stable_sort(
      faces.begin(), faces.end(), [](const auto &a, const auto &b) { return a.node < b.node; });
    first_face.assign(graph.n_local() + 1, 0);
    for (const BoundaryFace<dim> &face : faces)
      ++first_face[face.node + 1];
    std::partial_sum(first_face.begin(), first_face.end(), first_face.begin());
  }

  template <int dim>
  void SurfaceRecovery<dim>::add_conditions(const BoundaryFace<dim> &face,
                                            const double             time,
                                            const double             weight,
                                            ElasticFit<dim>         &fit) const
  {
    dealii::Tensor<1, dim> traction;
    std::array<bool, dim>  is_held{};
    for (std::size_t k = 0; k < loads.conditions.size(); ++k)
      if (loads.conditions[k].acts_on(face.boundary))
        {
          const BoundaryCondition<dim> &condition = loads.conditions[k];
          if (condition.prescribes_traction())
            traction += Loads<dim>::traction(condition, face.centre, face.normal, time);
          // What pulls along the normal is not known.
          if (condition.slides)
            is_held.fill(true);
          for (unsigned int d = 0; d < dim; ++d)
            if (condition.displacement[d].is_present())
              {
                is_held[d] = true;
                if (held == Held::at_faces)
                  fit.add_displacement(
                    face.centre, d, condition.displacement[d].value(face.centre, time), weight);
              }
        }
    for (unsigned int d = 0; d < dim; ++d)
      if (!is_held[d])
        fit.add_traction(face.centre, face.normal, d, traction[d], weight);
  }

  template <int dim>
  SurfaceState<dim> SurfaceRecovery<dim>::state_at(const BoundaryFace<dim>                   &face,
                                                   const Stencil                             &stencil,
                                                   const std::vector<dealii::Tensor<1, dim>> &displacement,
                                                   const double                               time) const
  {
    const double    size = 2. * face.centre.distance(graph.position[face.node]);
    ElasticFit<dim> fit(face.centre, size, displacement[face.node], solids.at(graph.material[face.node]));
    for (const LocalIndex k : stencil)
      {
        const double weight = 1. / (1. + face.centre.distance_square(graph.position[k]) / (size * size));
        for (unsigned int d = 0; d < dim; ++d)
          fit.add_displacement(graph.position[k], d, displacement[k][d], weight);
        fit.add_equilibrium(graph.position[k],
                            loads.body_force_at(graph.position[k], time, graph.material[k]),
                            equilibrium_weight);
        for (std::size_t f = first_face[k]; f < first_face[k + 1]; ++f)
          add_conditions(faces[f], time, &faces[f] == &face ? own_face_weight : other_face_weight, fit);
      }
    const auto result = fit.solve();
    return {face.node, face.centre, face.normal, result.displacement, result.gradient};
  }

  template <int dim>
  std::vector<SurfaceState<dim>>
  SurfaceRecovery<dim>::recover(const dealii::types::boundary_id           boundary,
                                const std::vector<dealii::Tensor<1, dim>> &displacement,
                                const double                               time) const
  {
    const auto                     all = graph.with_ghosts(displacement);
    std::vector<SurfaceState<dim>> result;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        {
          const LocalIndex i       = graph.node_of(cell);
          Stencil          stencil = graph.cells_around(cell);
          stencil.erase(
            std::remove_if(stencil.begin(),
                           stencil.end(),
                           [&](const LocalIndex k) { return graph.material[k] != graph.material[i]; }),
            stencil.end());
          for (std::size_t f = first_face[i]; f < first_face[i + 1]; ++f)
            if (faces[f].boundary == boundary)
              result.push_back(state_at(faces[f], stencil, all, time));
        }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(SurfaceRecovery)
} // namespace perideal
