// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/treatments/treatments.h>

/*
 * Treatment "surface nodes" of displacements: a node of its own at the centroid of each held face, with the
 * volume of its cell once more (SurfaceNodes; peridynamics with boundary conditions, PDBC section 5.1). Held
 * components of these nodes take the values there, the others are unknowns.
 */
namespace perideal
{
  namespace
  {
    template <int dim>
    class SurfaceNodeSupports : public Supports<dim>
    {
    public:
      explicit SurfaceNodeSupports(const TreatedBody<dim> &body)
        : Supports<dim>(body)
        , surface(body.nodes, body.faces, body.loads)
      {
        this->mirror     = std::make_shared<MirrorLayer<dim>>(surface.nodes());
        this->held_nodes = DirichletNodes<dim>(surface.faces(), body.loads, surface.nodes().size());
      }

      const NodeCloud<dim>    &unknowns() const override { return surface.nodes(); }
      const SurfaceNodes<dim> *surface_nodes() const override { return &surface; }

      std::string describe() const override
      {
        return Supports<dim>::describe() + " (" +
               grouped(surface.nodes().n_global - this->body.nodes.n_global) + ')';
      }

    private:
      const SurfaceNodes<dim> surface;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Supports<dim>> hold_by_surface_nodes(const TreatedBody<dim> &body)
  {
    return std::make_unique<SurfaceNodeSupports<dim>>(body);
  }

  PERIDEAL_INSTANTIATE(hold_by_surface_nodes)
} // namespace perideal
