// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/treatments/treatments.h>

/*
 * Treatment "layer": the outer cells stand for the surface.
 *
 * Displacements: nodes of the cells with a face on a held boundary take the prescribed value of the centre of
 * that face, half a spacing away: a first-order error. With more layers (Boundary conditions/Layers) the
 * cells within so many vertices of the boundary take the formula's value at their own nodes, as in the
 * fictitious layer of Silling and Askari (2005), here a part of the body.
 *
 * Tractions are body forces in the outer layer: the node of the cell carries t A of each of its faces.
 */
namespace perideal
{
  namespace
  {
    template <int dim>
    class LayerSupports : public Supports<dim>
    {
    public:
      explicit LayerSupports(const TreatedBody<dim> &body)
        : Supports<dim>(body)
      {
        this->hold_layers();
      }

      bool reach_surface() const override { return false; }
    };

    template <int dim>
    class LayerTractions : public Tractions<dim>
    {
    public:
      using Tractions<dim>::Tractions;

      void add_tractions(const Loads<dim> &given, const double time, NodalVector &force) const override
      {
        visit_loaded_faces(given,
                           this->body.faces,
                           [&](const BoundaryCondition<dim> &condition, const BoundaryFace<dim> &face) {
                             const auto traction =
                               Loads<dim>::traction(condition, face.centre, face.normal, time);
                             for (int d = 0; d < dim; ++d)
                               force.local_element(dim * face.node + d) += traction[d] * face.area;
                           });
      }
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Supports<dim>> hold_by_layer(const TreatedBody<dim> &body)
  {
    return std::make_unique<LayerSupports<dim>>(body);
  }

  template <int dim>
  std::unique_ptr<Tractions<dim>> load_by_layer(const TreatedBody<dim> &body, const TreatedBonds<dim> &bonds)
  {
    return std::make_unique<LayerTractions<dim>>(body, bonds);
  }

  PERIDEAL_INSTANTIATE(hold_by_layer)
  PERIDEAL_INSTANTIATE(load_by_layer)
} // namespace perideal
