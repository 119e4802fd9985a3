// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_bulk_strength_h
#define perideal_materials_bulk_strength_h

#include <perideal/materials/separation.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace perideal
{
  /**
   * Computes what a family of bonds that soften bears in tension. It is pulled along n, with the lateral
   * contraction of the solid, eps = e (n n - nu (I - n n)), and each bond has what its softening law leaves
   * of it (SofteningLaw). The stress along n is the work of what is left on a strain n n.
   *
   * Bonds along the pull soften first, while slanted ones still gain force: where bonds soften slowly the
   * largest stress is up to half as much again as that at which the first bond begins. Bonds that are to bear
   * a strength f_t together must begin earlier.
   */
  template <int dim>
  class BulkStrength
  {
  public:
    /// @param lateral nu of the plane or the solid [-]
    /// The arguments must outlive this object.
    BulkStrength(const FamilyView<dim>                     &family,
                 const FamilyCoefficients                  &coefficients,
                 const FamilyShape                         &shape,
                 const std::vector<dealii::Tensor<1, dim>> &normals,
                 const double                               lateral);

    /// Returns the largest stress over the stiffness of the whole family, on the mean over the normals [-].
    /// @param squares of the critical stretches for a unit of energy, by member (Separation)
    double largest_strain(const std::vector<double> &squares, const BondFailing &how) const;

    /// Returns the first stretch with which largest_strain() is a strain, f_t over the stiffness [-]; that
    /// strain itself where bonds would break at once.
    double first_stretch(const double strain, const std::vector<double> &squares, BondFailing how) const;

  private:
    const FamilyView<dim>                     &family;
    const FamilyCoefficients                  &coefficients;
    const FamilyShape                          shape;
    const std::vector<dealii::Tensor<1, dim>> &normals;
    const double                               lateral;
  };
} // namespace perideal

#endif
