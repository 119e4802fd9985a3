// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_face_springs_h
#define perideal_operators_linear_face_springs_h

#include <perideal/operators/linear/bond_operator.h>
#include <perideal/operators/weights/gradient_moments.h>

#include <memory>
#include <vector>

namespace perideal
{
  /**
   * The consistent form on an elastic foundation: with the value v of a cell's polynomial at a boundary face
   * and a stiffness k in a unit of area, along the normal n or in all directions,
   *
   *     U = U of the cells + 1/2 int k (v.n)^2 dA   or   1/2 int k |v|^2 dA.
   *
   * Tractions act on the same value.
   */
  template <int dim>
  class FaceSprings : public BondOperator<dim>
  {
  public:
    /// @param loads with the conditions that have springs
    FaceSprings(const std::shared_ptr<const BondOperator<dim>>    &cells,
                const std::shared_ptr<const GradientMoments<dim>> &moments,
                const Loads<dim>                                  &loads);

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    void internal_force(NodalVector &force, const NodalVector &displacement) const override;
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const override;
    /// Not for springs.
    void assemble(const typename BondOperator<dim>::AddBlock &) const override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    std::vector<dealii::Tensor<1, dim>> support_forces() const override { return cells->support_forces(); }
    double              energy_of_expansion() const override { return cells->energy_of_expansion(); }
    std::vector<double> dilatation() const override { return cells->dilatation(); }
    bool                is_symmetric() const override { return true; }
    std::size_t         memory_consumption() const override;

    /// Forces of the springs on the body by condition, on this rank [N]. Collective.
    std::vector<dealii::Tensor<1, dim>> spring_forces(const NodalVector &displacement) const;

  private:
    /// A point of a face with a spring.
    struct Spring
    {
      /// [N/m]
      dealii::SymmetricTensor<2, dim> stiffness;
      unsigned int                    condition;
    };

    /// Forces of nodes that the springs resist with [N]. Collective.
    void compute(NodalVector &force, const NodalVector &displacement) const;

    std::shared_ptr<const BondOperator<dim>>          cells;
    std::shared_ptr<const GradientMoments<dim>>       moments;
    std::vector<typename GradientMoments<dim>::Place> places;
    std::vector<Spring>                               springs;
    unsigned int                                      n_conditions;
  };
} // namespace perideal

#endif
