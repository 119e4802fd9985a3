// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/spread_bits.h>
#include <perideal/operators/weights/calibration_memo.h>

#include <cstring>

namespace perideal
{
  namespace
  {
    /// Two hashes of a sequence of words, which have nothing in common but the words.
    class WordHashes
    {
    public:
      void add(const std::uint64_t word)
      {
        value[0] = spread_bits(value[0] ^ word);
        value[1] = spread_bits(value[1] + 0x9e3779b97f4a7c15u) ^ spread_bits(~word);
      }

      void add(const double number)
      {
        std::uint64_t word;
        std::memcpy(&word, &number, sizeof(word));
        add(word);
      }

      CalibrationMemo::Key value = {{1, 2}};
    };
  } // namespace

  template <int dim>
  CalibrationMemo::Key CalibrationMemo::key_of(const FamilyView<dim>           &family,
                                               const dealii::types::material_id material,
                                               const unsigned int               how)
  {
    WordHashes hashes;
    hashes.add(std::uint64_t{family.size});
    hashes.add(std::uint64_t{material} << 32 | how);
    hashes.add(family.node_volume);
    hashes.add(family.horizon);
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        for (int d = 0; d < dim; ++d)
          hashes.add(family.bond[d][j]);
        hashes.add(family.volume[j]);
        hashes.add(family.bond_horizon[j]);
      }
    return hashes.value;
  }

  const CalibratedFamily *CalibrationMemo::find(const Key &key)
  {
    const auto place = known.find(key);
    if (place == known.end())
      return nullptr;
    place->second.is_used = true;
    return &place->second.family;
  }

  void CalibrationMemo::insert(const Key &key, const CalibratedFamily &family)
  {
    known[key] = {family, true};
  }

  void CalibrationMemo::forget_unused()
  {
    for (auto entry = known.begin(); entry != known.end();)
      if (entry->second.is_used)
        {
          entry->second.is_used = false;
          ++entry;
        }
      else
        entry = known.erase(entry);
  }

  template CalibrationMemo::Key
  CalibrationMemo::key_of(const FamilyView<2> &, const dealii::types::material_id, const unsigned int);
  template CalibrationMemo::Key
  CalibrationMemo::key_of(const FamilyView<3> &, const dealii::types::material_id, const unsigned int);
} // namespace perideal
