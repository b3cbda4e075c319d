// SPDX-License-Identifier: BSD-3-Clause
// Counter-based random numbers: each number is a pure function of (seed, purpose, key, slot), so any rank can compute
// any number.
#pragma once

#include <cstdint>

namespace trime {

/// The purpose for which a random number is used. Different purposes get different numbers.
enum class RandomPurpose : std::uint64_t { site_position = 1, deletion = 2, size_sample = 3, test = 99 };

/// The finaliser of splitmix64 (Steele, Lea, Flood 2014), a bijection in which every input bit changes many output
/// bits.
constexpr std::uint64_t mix_bits(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// Returns 64 random bits for (seed, purpose, key, slot).
constexpr std::uint64_t random_bits(std::uint64_t seed, RandomPurpose purpose, std::uint64_t key, std::uint64_t slot) {
  return mix_bits(mix_bits(mix_bits(mix_bits(seed) ^ static_cast<std::uint64_t>(purpose)) ^ key) ^ slot);
}

/// Returns a uniform random number in [0, 1) with 53 bits.
constexpr double random_unit(std::uint64_t seed, RandomPurpose purpose, std::uint64_t key, std::uint64_t slot) {
  return static_cast<double>(random_bits(seed, purpose, key, slot) >> 11) * 0x1p-53;
}

} // namespace trime
