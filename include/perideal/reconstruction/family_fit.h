// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_family_fit_h
#define perideal_reconstruction_family_fit_h

#include <perideal/base/types.h>
#include <perideal/neighbourhood/families.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace perideal
{
  /**
   * Computes the gradient of a nodal field from the linear polynomial that fits it best, by least squares
   * weighted with volumes, over a node and those members of its family that are added. Displacements of bonds
   * whose weights were not made for a gradient jitter from cell to cell, most on graded meshes; over a family
   * that averages out. Exact for linear fields; where bonds are broken, from the node's side of the crack
   * alone.
   */
  template <int dim>
  class FamilyFit
  {
  public:
    /// @param field dim values a node, laid out as families.make_partitioner(dim), ghosts up to date. Both
    /// arguments must outlive this object.
    FamilyFit(const Families<dim> &families, const NodalVector &field);

    /// Adds local node @p j to the fit of owned node @p i.
    void add(const LocalIndex i, const LocalIndex j)
    {
      Moments                     &m      = moments[i];
      const dealii::Tensor<1, dim> offset = families.position[j] - families.position[i];
      dealii::Tensor<1, dim>       step;
      for (int d = 0; d < dim; ++d)
        step[d] = field.local_element(dim * j + d) - field.local_element(dim * i + d);
      const double volume = families.volume[j];
      m.volume += volume;
      m.offset += volume * offset;
      m.step += volume * step;
      m.of_offsets += volume * symmetrize(outer_product(offset, offset));
      m.of_steps += volume * outer_product(step, offset);
    }

    /// Returns (d u_a/d x_b) by owned node, 0 in directions in which no member lies.
    std::vector<dealii::Tensor<2, dim>> gradients() const;

  private:
    /// Sums over the node and its members, of offsets and steps from the node.
    struct Moments
    {
      double                          volume = 0;
      dealii::Tensor<1, dim>          offset, step;
      dealii::SymmetricTensor<2, dim> of_offsets;
      dealii::Tensor<2, dim>          of_steps;
    };

    const Families<dim> &families;
    const NodalVector   &field;
    std::vector<Moments> moments;
  };
} // namespace perideal

#endif
