// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/spread_bits.h>
#include <perideal/operators/weights/canonical_family.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace perideal
{
  namespace
  {
    using Word = std::uint64_t;

    /// The bits of a number; zero has one sign.
    Word bits_of(const double number)
    {
      const double unsigned_zero = number + 0.;
      Word         result;
      std::memcpy(&result, &unsigned_zero, sizeof(result));
      return result;
    }

    /// Components that change places and signs.
    template <int dim>
    struct Image
    {
      /// Which component stands at each place, and its sign.
      std::array<unsigned int, dim> component;
      std::array<double, dim>       sign;
    };

    template <int dim>
    std::vector<Image<dim>> all_images()
    {
      std::vector<Image<dim>> result;
      Image<dim>              image;
      std::iota(image.component.begin(), image.component.end(), 0u);
      do
        for (unsigned int signs = 0; signs < (1u << dim); ++signs)
          {
            for (int d = 0; d < dim; ++d)
              image.sign[d] = (signs >> d) & 1 ? -1. : 1.;
            result.push_back(image);
          }
      while (std::next_permutation(image.component.begin(), image.component.end()));
      return result;
    }

    /// A number for each image, the same whatever the order of the members; the image of the least is chosen.
    template <int dim>
    Image<dim> choose_image(const FamilyView<dim> &family)
    {
      static const std::vector<Image<dim>> images = all_images<dim>();
      std::vector<Word>                    sums(images.size(), 0);
      // Of a member, by component, place and sign.
      std::array<std::array<std::array<Word, 2>, dim>, dim> words;
      for (LocalIndex j = 0; j < family.size; ++j)
        {
          for (int c = 0; c < dim; ++c)
            for (unsigned int sign = 0; sign < 2; ++sign)
              {
                const Word word = spread_bits(bits_of(sign == 0 ? family.bond[c][j] : -family.bond[c][j]));
                for (int d = 0; d < dim; ++d)
                  words[c][d][sign] = word * (2 * d + 3);
              }
          const Word of_volume =
            spread_bits(bits_of(family.volume[j])) ^ spread_bits(~bits_of(family.bond_horizon[j]));
          for (std::size_t k = 0; k < images.size(); ++k)
            {
              Word word = of_volume;
              for (int d = 0; d < dim; ++d)
                word += words[images[k].component[d]][d][images[k].sign[d] < 0];
              sums[k] += spread_bits(word);
            }
        }
      return images[std::min_element(sums.begin(), sums.end()) - sums.begin()];
    }
  } // namespace

  template <int dim>
  CanonicalFamily<dim> canonical_family(const FamilyView<dim> &family, const bool has_images)
  {
    CanonicalFamily<dim> result{family, std::vector<LocalIndex>(family.size)};
    std::iota(result.member_of.begin(), result.member_of.end(), 0u);
    if (!has_images)
      return result;
    const Image<dim> image = choose_image(family);
    auto            &to    = result.family;
    for (int d = 0; d < dim; ++d)
      for (LocalIndex j = 0; j < family.size; ++j)
        to.bond[d][j] = image.sign[d] * family.bond[image.component[d]][j];
    const auto imaged = to.bond;
    std::sort(result.member_of.begin(), result.member_of.end(), [&](const LocalIndex a, const LocalIndex b) {
      for (int d = 0; d < dim; ++d)
        if (imaged[d][a] != imaged[d][b])
          return imaged[d][a] < imaged[d][b];
      return a < b;
    });
    for (LocalIndex k = 0; k < family.size; ++k)
      {
        const LocalIndex j = result.member_of[k];
        to.member[k]       = family.member[j];
        to.volume[k]       = family.volume[j];
        to.bond_horizon[k] = family.bond_horizon[j];
        // Summed over the places, as of every image.
        to.length_square[k] = 0.;
        for (int d = 0; d < dim; ++d)
          {
            to.bond[d][k] = imaged[d][j] + 0.;
            to.length_square[k] += to.bond[d][k] * to.bond[d][k];
          }
      }
    return result;
  }

  PERIDEAL_INSTANTIATE(canonical_family)
} // namespace perideal
