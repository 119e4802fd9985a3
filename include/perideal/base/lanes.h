// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_lanes_h
#define perideal_base_lanes_h

#ifdef __AVX__
#  include <immintrin.h>
#endif

/**
 * Computes with four doubles at once in the bond loops. Compiler vectors become
 * AVX registers where the target has them and pairs of SSE registers elsewhere.
 * (dealii::VectorizedArray has one lane in a distribution's portable build.)
 */
namespace perideal
{
  using Lanes = double __attribute__((vector_size(32)));

  /// Four numbers of a node, loaded and stored as one: x, y, z and a state.
  struct alignas(32) NodeRecord
  {
    double value[4];
  };

#define PERIDEAL_INLINE inline __attribute__((always_inline))

  PERIDEAL_INLINE const Lanes &lanes(const NodeRecord &record)
  {
    return reinterpret_cast<const Lanes &>(record);
  }

  PERIDEAL_INLINE Lanes &lanes(NodeRecord &record)
  {
    return reinterpret_cast<Lanes &>(record);
  }

  /// Four consecutive numbers from anywhere.
  PERIDEAL_INLINE void load(Lanes &result, const double *from)
  {
    __builtin_memcpy(&result, from, sizeof(Lanes));
  }

  PERIDEAL_INLINE void load(Lanes &result, const float *from)
  {
    float numbers __attribute__((vector_size(16)));
    __builtin_memcpy(&numbers, from, sizeof(numbers));
    result = __builtin_convertvector(numbers, Lanes);
  }

  /// The sums over the entries of a, b, c and d.
  PERIDEAL_INLINE void
  sum_of_each(Lanes &result, const Lanes &a, const Lanes &b, const Lanes &c, const Lanes &d)
  {
    const Lanes ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Lanes cd = __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
    result = __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  }

  /// The i-th entries of a[0] to a[3] in the i-th result.
  PERIDEAL_INLINE void transpose(const Lanes (&a)[4], Lanes (&result)[4])
  {
    const Lanes even01 = __builtin_shufflevector(a[0], a[1], 0, 4, 2, 6);
    const Lanes odd01  = __builtin_shufflevector(a[0], a[1], 1, 5, 3, 7);
    const Lanes even23 = __builtin_shufflevector(a[2], a[3], 0, 4, 2, 6);
    const Lanes odd23  = __builtin_shufflevector(a[2], a[3], 1, 5, 3, 7);
    result[0]          = __builtin_shufflevector(even01, even23, 0, 1, 4, 5);
    result[1]          = __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);
    result[2]          = __builtin_shufflevector(even01, even23, 2, 3, 6, 7);
    result[3]          = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);
  }

  PERIDEAL_INLINE Lanes square_root(const Lanes &a)
  {
#ifdef __AVX__
    return _mm256_sqrt_pd(a);
#else
    return Lanes{__builtin_sqrt(a[0]), __builtin_sqrt(a[1]), __builtin_sqrt(a[2]), __builtin_sqrt(a[3])};
#endif
  }

  /// Whether any of the numbers is below zero.
  PERIDEAL_INLINE bool any_negative(const Lanes &a)
  {
#ifdef __AVX__
    return _mm256_movemask_pd(a) != 0;
#else
    return a[0] < 0 || a[1] < 0 || a[2] < 0 || a[3] < 0;
#endif
  }

  PERIDEAL_INLINE double sum_of_all(const Lanes &a)
  {
    return (a[0] + a[1]) + (a[2] + a[3]);
  }
} // namespace perideal

#endif
