// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/treatments/treatments.h>

/*
 * Treatment "reference" of displacements: nodes of the cells at a held boundary, or of more layers of them,
 * take what a reference solution by finite elements has at the node, so that nothing but the interior is
 * left of the error: for studies. The reference belongs to the loads at t = 1; those of linear scenes scale.
 */
namespace perideal
{
  namespace
  {
    template <int dim>
    class ReferenceSupports : public Supports<dim>
    {
    public:
      explicit ReferenceSupports(const TreatedBody<dim> &body)
        : Supports<dim>(body)
      {
        this->hold_layers();
      }

      bool needs_reference() const override { return true; }
      void set_reference(const std::vector<dealii::Tensor<1, dim>> &displacement) override
      {
        reference = displacement;
      }

      void set_displacements(const double time, NodalVector &displacement) const override
      {
        auto scaled = reference;
        for (auto &value : scaled)
          value *= time;
        this->held_nodes.set_nodal_values(scaled, displacement);
      }

    private:
      std::vector<dealii::Tensor<1, dim>> reference;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Supports<dim>> hold_by_reference(const TreatedBody<dim> &body)
  {
    return std::make_unique<ReferenceSupports<dim>>(body);
  }

  PERIDEAL_INSTANTIATE(hold_by_reference)
} // namespace perideal
