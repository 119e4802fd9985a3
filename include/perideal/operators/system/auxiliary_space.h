// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_system_auxiliary_space_h
#define perideal_operators_system_auxiliary_space_h

#include <perideal/operators/system/auxiliary_elements.h>
#include <perideal/operators/system/block_jacobi.h>

#include <memory>

namespace perideal
{
  /**
   * Applies the auxiliary-space preconditioner B = S + P V P^T: block Jacobi S, scaled by
   * the largest eigenvalue, reduces rough errors; AuxiliaryElements, which are finite elements of the same
   * body, smooth ones.
   */
  template <int dim>
  class AuxiliarySpace
  {
  public:
    /// The system must outlive this object.
    AuxiliarySpace(const ConstrainedOperator<dim>                      &system,
                   const std::shared_ptr<const AuxiliaryElements<dim>> &elements);

    void vmult(NodalVector &destination, const NodalVector &source) const;

  private:
    const ConstrainedOperator<dim>               &system;
    BlockJacobi<dim>                              smoother;
    std::shared_ptr<const AuxiliaryElements<dim>> elements;
  };
} // namespace perideal

#endif
