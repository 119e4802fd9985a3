// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_treatments_tractions_h
#define perideal_treatments_tractions_h

#include <perideal/boundary/face_tractions.h>
#include <perideal/operators/linear/bond_operator.h>
#include <perideal/treatments/treated_body.h>

#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <optional>
#include <string>

namespace perideal
{
  /**
   * How tractions and pressures load the nodes: one treatment of Boundary conditions/Traction treatment. A
   * treatment says what it adds to the operator of the bonds, and the forces that it puts on nodes.
   */
  template <int dim>
  class Tractions
  {
  public:
    Tractions(const TreatedBody<dim> &body, const TreatedBonds<dim> &bonds)
      : body(body)
      , bonds(bonds)
    {
    }
    virtual ~Tractions() = default;

    /// Returns the operator of the bonds with what the treatment adds to it; statics only, once. Collective.
    /// @throws InputError when it cannot for this body.
    virtual std::shared_ptr<BondOperator<dim>> around(const std::shared_ptr<BondOperator<dim>> &bonds)
    {
      return bonds;
    }

    /// Adds the forces on owned nodes that come of the tractions of some loads on the conditions of the body,
    /// linear in them [N]. Collective.
    virtual void add_tractions(const Loads<dim> &given, const double time, NodalVector &force) const = 0;

    /// Adds the external forces that belong to what around() added [N].
    virtual void add_given(const double /*time*/, NodalVector & /*force*/) const {}

    /// Whether the forces on nodes balance as far as the tractions do, but for rounding.
    virtual bool keep_balance() const { return true; }

    /// Whether tractions are forces on nodes and nothing else, so that those of all conditions add up to the
    /// external force.
    virtual bool are_nodal_forces() const { return true; }

    /// What the body gets of the tractions of a condition, on this rank. Collective.
    /// @param displacement of the solution at that time
    virtual Resultant<dim>
    resultant(const unsigned int condition, const double time, const NodalVector &displacement) const;

    /// Resultant of forces on the nodes of cells of this rank.
    Resultant<dim> add_up(const NodalVector &force) const;

    /// Whether what around() added stands for the bonds that families lack at surfaces.
    virtual bool complete_families() const { return false; }

    /// C of whole families by their quadrature [Pa], where around() has found it.
    virtual std::optional<dealii::SymmetricTensor<4, dim>> stiffness() const { return std::nullopt; }

    /// What the banner says of the treatment behind that of displacements; empty for the usual one.
    virtual std::string describe() const { return ""; }

  protected:
    const TreatedBody<dim>  body;
    const TreatedBonds<dim> bonds;
  };
} // namespace perideal

#endif
