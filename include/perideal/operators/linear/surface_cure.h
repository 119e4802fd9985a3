// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_surface_cure_h
#define perideal_operators_linear_surface_cure_h

#include <perideal/operators/linear/bond_operator.h>
#include <perideal/operators/weights/nodal_gradient.h>

#include <deal.II/base/tensor.h>

#include <map>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Adds to tensor-involved bonds what they lack at surfaces: at a free surface their natural condition is
   * (S : grad u) n = 0 in the place of (C : eps) n = 0. The difference in energy,
   *
   *     1/2 sum_i V_i (G_i u) : (C - S) : (G_i u),
   *
   * with the face gradient G, belongs to a null Lagrangian: it pulls at surfaces, and inside a regular mesh
   * its forces vanish.
   */
  template <int dim>
  class SurfaceCure : public BondOperator<dim>
  {
  public:
    /// @param bonds the operator of the bonds alone
    /// @param solid_of every material of the nodes. Collective.
    SurfaceCure(const std::shared_ptr<const BondOperator<dim>> &bonds,
                const std::shared_ptr<const FaceGradient<dim>> &gradient,
                const std::vector<double>                      &volume,
                const SolidOf<dim>                             &solid_of);

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const override;
    void assemble(const typename BondOperator<dim>::AddBlock &add) const override;

    /// Trace of the gradient of the last vmult(), by owned node.
    std::vector<double> dilatation() const override { return traces; }
    bool                is_symmetric() const override { return bonds->is_symmetric(); }
    std::size_t         memory_consumption() const override;

  private:
    /// V_i (C - S) of owned node i [N m].
    dealii::Tensor<4, dim> defect(const LocalIndex i) const { return volume[i] * defects.at(material(i)); }

    dealii::types::material_id material(const LocalIndex i) const
    {
      return gradient.of_faces().graph().material[i];
    }

    std::shared_ptr<const BondOperator<dim>>                     bonds;
    NodalGradient<dim>                                           gradient;
    std::vector<double>                                          volume;
    std::map<dealii::types::material_id, dealii::Tensor<4, dim>> defects;

    // Work space of vmult().
    mutable NodalVector         forces;
    mutable std::vector<double> traces;
  };
} // namespace perideal

#endif
