// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_calibration_memo_h
#define perideal_operators_weights_calibration_memo_h

#include <perideal/materials/linear_model.h>
#include <perideal/materials/separation.h>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace perideal
{
  /// What calibration makes of the bonds of one family.
  struct CalibratedFamily
  {
    /// Squares of the stretches for a unit of the mean fracture energy, by member [m^2/J].
    std::vector<double> squares;
    /// Where its bonds begin to soften [-].
    double first = 0;
    /// What planes take of the fracture energy.
    EnergyByDirection shares;
  };

  /**
   * Keeps what families were calibrated to while the mesh, or the zone with bonds, changes under a scene:
   * most families are then those of before. They are recognised by all bits of what they are calibrated from,
   * not by a tolerance, so that a scene that goes on from a checkpoint, and begins without a memo, gets the
   * same stretches to the last bit.
   */
  class CalibrationMemo
  {
  public:
    /// 128 bits made of what a family is calibrated from. Two of n families share them with a probability of
    /// n^2/2^129.
    using Key = std::array<std::uint64_t, 2>;

    /// Returns the key of a family.
    /// @param how any number that stands for how the family is calibrated besides
    template <int dim>
    static Key
    key_of(const FamilyView<dim> &family, const dealii::types::material_id material, const unsigned int how);

    /// Returns what a family was calibrated to; null where that is not known.
    const CalibratedFamily *find(const Key &key);

    void insert(const Key &key, const CalibratedFamily &family);

    /// Forgets the families that nobody found or inserted since the last call: those of a mesh that is gone.
    void forget_unused();

    std::size_t size() const { return known.size(); }

  private:
    struct Entry
    {
      CalibratedFamily family;
      bool             is_used = true;
    };
    struct Hash
    {
      std::size_t operator()(const Key &key) const { return key[0]; }
    };
    std::unordered_map<Key, Entry, Hash> known;
  };
} // namespace perideal

#endif
