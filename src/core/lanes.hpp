// SPDX-License-Identifier: BSD-3-Clause
// Computes with several doubles at once, by the vector extension of g++ and clang++. Every lane gets the same bits as
// scalar code: multiplications and additions are not fused, and sums do not mix lanes. Elements are loaded one by one,
// because gather instructions are slow on common processors. All functions are inlined by force, so that code for one
// processor is never executed on another.
#pragma once

#include <cstdint>
#include <cstring>

#if defined(__AVX__)
#include <immintrin.h> // takes a second of the build
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

#define TRIME_INLINE [[gnu::always_inline]] inline

namespace trime::lanes {

template <int n>
struct Types {
  using Doubles [[gnu::vector_size(8 * n)]] = double;
  using Mask [[gnu::vector_size(8 * n)]] = std::int64_t; // -1 in lanes where a comparison is true
};

/// The type of the result when two vectors of type V are compared.
template <class V>
struct MaskOf {
  using Type = decltype(V{} < V{});
};
template <class V>
using Mask = typename MaskOf<V>::Type;

// Overloads for plain numbers, so that scalar code and vector code can share formulas.
TRIME_INLINE double select(bool mask, double a, double b) {
  return mask ? a : b;
}
TRIME_INLINE double square_root(double v) {
  return __builtin_sqrt(v);
}

template <class V>
TRIME_INLINE V select(Mask<V> mask, V a, V b) {
  return mask ? a : b;
}

template <class V>
TRIME_INLINE V square_root(V v) {
  constexpr int n = sizeof(V) / 8;
#ifdef __AVX512F__
  if constexpr (n == 8)
    return (V)_mm512_maskz_sqrt_pd(0xff, (__m512d)v);
#endif
#ifdef __AVX__
  if constexpr (n == 4)
    return (V)_mm256_sqrt_pd((__m256d)v);
#endif
#ifdef __SSE2__
  if constexpr (n == 2)
    return (V)_mm_sqrt_pd((__m128d)v);
#endif
  V r;
  for (int k = 0; k < n; ++k)
    r[k] = __builtin_sqrt(v[k]);
  return r;
}

/// Returns the larger value of each lane; b if one of the two is NaN.
template <class V>
TRIME_INLINE V larger(V a, V b) {
#ifdef __SSE2__
  if constexpr (sizeof(V) == 16)
    return (V)_mm_max_pd((__m128d)a, (__m128d)b);
#endif
#ifdef __AVX__
  if constexpr (sizeof(V) == 32)
    return (V)_mm256_max_pd((__m256d)a, (__m256d)b);
#endif
#ifdef __AVX512F__
  if constexpr (sizeof(V) == 64)
    return (V)_mm512_maskz_max_pd(0xff, (__m512d)a, (__m512d)b);
#endif
  return a > b ? a : b;
}

/// Returns the smaller value of each lane; b if one of the two is NaN.
template <class V>
TRIME_INLINE V smaller(V a, V b) {
#ifdef __SSE2__
  if constexpr (sizeof(V) == 16)
    return (V)_mm_min_pd((__m128d)a, (__m128d)b);
#endif
  return a < b ? a : b;
}

/// Converts a mask to an integer with one bit for each lane.
template <class M>
TRIME_INLINE unsigned bits(M mask) {
  constexpr int n = sizeof(M) / 8;
#ifdef __AVX512F__
  if constexpr (n == 8)
    return _mm512_test_epi64_mask((__m512i)mask, (__m512i)mask);
#endif
#ifdef __AVX__
  if constexpr (n == 4)
    return static_cast<unsigned>(_mm256_movemask_pd((__m256d)mask));
#endif
#ifdef __SSE2__
  if constexpr (n == 2)
    return static_cast<unsigned>(_mm_movemask_pd((__m128d)mask));
#endif
  unsigned result = 0;
  for (int k = 0; k < n; ++k)
    result |= static_cast<unsigned>(mask[k] & 1) << k;
  return result;
}

/// Vectors of the first and of the second numbers of n pairs.
template <class V>
struct Pairs {
  V x, y;
};

/// Loads n pairs of doubles from n addresses.
template <class V>
TRIME_INLINE Pairs<V> load_pairs(const double* const (&from)[sizeof(V) / 8]) {
  constexpr int n = sizeof(V) / 8;
  using Two = Types<2>::Doubles;
  Two pair[n];
  for (int k = 0; k < n; ++k)
    std::memcpy(&pair[k], from[k], sizeof(Two));
  if constexpr (n == 2) {
    return {__builtin_shufflevector(pair[0], pair[1], 0, 2), __builtin_shufflevector(pair[0], pair[1], 1, 3)};
  } else {
    using Four = Types<4>::Doubles;
    Four x[n / 4], y[n / 4];
    for (int k = 0; k < n / 4; ++k) {
      const Four low = __builtin_shufflevector(pair[4 * k], pair[4 * k + 2], 0, 1, 2, 3);
      const Four high = __builtin_shufflevector(pair[4 * k + 1], pair[4 * k + 3], 0, 1, 2, 3);
      x[k] = __builtin_shufflevector(low, high, 0, 4, 2, 6);
      y[k] = __builtin_shufflevector(low, high, 1, 5, 3, 7);
    }
    if constexpr (n == 4)
      return {x[0], y[0]};
    else
      return {__builtin_shufflevector(x[0], x[1], 0, 1, 2, 3, 4, 5, 6, 7),
              __builtin_shufflevector(y[0], y[1], 0, 1, 2, 3, 4, 5, 6, 7)};
  }
}

/// Returns the nearest integers; halves are rounded to even, as in round_to_integer.
/// @pre |v| <= 2^51
template <class V>
TRIME_INLINE V nearest(V v) {
  return (v + 0x1.8p52) - 0x1.8p52;
}

/// Returns the nearest integer multiples of 2^-32, as FixedSum computes them.
/// @pre |v| < 2^18
template <class V>
TRIME_INLINE Mask<V> fixed_point(V v) {
  constexpr std::int64_t origin = 0x4338000000000000; // bits of 1.5 * 2^52
  const V raised = v * 0x1p32 + 0x1.8p52;
  Mask<V> result;
  std::memcpy(&result, &raised, sizeof result);
  return result - origin;
}

template <class M>
TRIME_INLINE std::int64_t sum_of_lanes(M v) {
  std::int64_t sum = 0;
  for (unsigned k = 0; k < sizeof(M) / 8; ++k)
    sum += v[k];
  return sum;
}

template <class V>
TRIME_INLINE double largest_lane(V v) {
  double largest = v[0];
  for (unsigned k = 1; k < sizeof(V) / 8; ++k)
    largest = v[k] > largest ? v[k] : largest;
  return largest;
}

} // namespace trime::lanes
