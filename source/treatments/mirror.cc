// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/treatments/treatments.h>

/*
 * Treatment "mirror" of displacements: behind plane boundaries the families are completed by images of the
 * nodes, which move by 2 g - u where a component is held and by u where it is free (MirrorLayer). Supports
 * act through the bonds between nodes and images.
 */
namespace perideal
{
  namespace
  {
    template <int dim>
    class MirrorSupports : public Supports<dim>
    {
    public:
      explicit MirrorSupports(const TreatedBody<dim> &body)
        : Supports<dim>(body)
      {
        this->mirror = std::make_shared<MirrorLayer<dim>>(body.mesh, body.nodes, body.faces, body.loads);
      }

      bool hold_nodes() const override { return false; }

      std::string describe() const override
      {
        const GlobalIndex n_images = this->mirror->nodes().n_global - this->body.nodes.n_global;
        return Supports<dim>::describe() +
               (n_images > 0 ? ", " + grouped(n_images) + " fictitious nodes" : "");
      }

    protected:
      MirrorReactions<dim> act_on_surface(const ConstrainedOperator<dim> &system) const override
      {
        return sum_mirror_reactions(system, this->body.loads.conditions.size());
      }
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Supports<dim>> hold_by_mirror(const TreatedBody<dim> &body)
  {
    return std::make_unique<MirrorSupports<dim>>(body);
  }

  PERIDEAL_INSTANTIATE(hold_by_mirror)
} // namespace perideal
