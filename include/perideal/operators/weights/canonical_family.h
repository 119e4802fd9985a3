// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_canonical_family_h
#define perideal_operators_weights_canonical_family_h

#include <perideal/materials/linear_model.h>

#include <vector>

namespace perideal
{
  /// One family that stands for all its images.
  template <int dim>
  struct CanonicalFamily
  {
    /// Its members in an order of their own.
    FamilyView<dim> family;
    /// Of which member of the family that was given each is the image.
    std::vector<LocalIndex> member_of;
  };

  /**
   * Returns the one among the images of a family that all of them share, to the last bit, if equal families
   * have the same bits: its axes change places and directions, 8 ways in the plane and 48 in space. Where
   * halved cells lie beside whole ones, most families are images of a few.
   *
   * @param has_images whether images of a family are equal to it in all that matters: of isotropic solids;
   * else it is the family itself, its members in order
   */
  template <int dim>
  CanonicalFamily<dim> canonical_family(const FamilyView<dim> &family, const bool has_images);
} // namespace perideal

#endif
