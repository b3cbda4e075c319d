// SPDX-License-Identifier: BSD-3-Clause
#include "core/hilbert.hpp"

#include <array>

namespace trime {
namespace {

/// Quadrants of the curve, and how the pieces in the last of them are turned: 1 stands for x and y exchanged, 2 for
/// both mirrored.
struct CurveStep {
  std::uint8_t key, turn;
};

constexpr CurveStep curve_step(unsigned x, unsigned y, unsigned turn) {
  const unsigned right = ((turn & 1) ? y : x) ^ (turn >> 1), upper = ((turn & 1) ? x : y) ^ (turn >> 1);
  const unsigned quadrant = right ? (upper ? 2 : 3) : upper;
  return {static_cast<std::uint8_t>(quadrant), static_cast<std::uint8_t>(upper ? turn : turn ^ (right ? 3U : 1U))};
}

/// Four steps at once, by turn and four bits of x and y each.
using FourSteps = std::array<std::array<CurveStep, 256>, 4>;
constexpr FourSteps make_four_steps() {
  FourSteps table{};
  for (unsigned turn = 0; turn < 4; ++turn)
    for (unsigned at = 0; at < 256; ++at) {
      unsigned key = 0, turned = turn;
      for (int bit = 3; bit >= 0; --bit) {
        const CurveStep step = curve_step((at >> (4 + bit)) & 1, (at >> bit) & 1, turned);
        key = (key << 2) | step.key;
        turned = step.turn;
      }
      table[turn][at] = {static_cast<std::uint8_t>(key), static_cast<std::uint8_t>(turned)};
    }
  return table;
}
constexpr FourSteps four_steps = make_four_steps();

/// Where the k-th quarter of a turned square lies: bit 1 to the right, bit 0 above; and how it is turned.
constexpr std::array<std::array<CurveStep, 4>, 4> make_quarters() {
  std::array<std::array<CurveStep, 4>, 4> quarters{};
  for (unsigned turn = 0; turn < 4; ++turn)
    for (unsigned at = 0; at < 4; ++at) {
      const CurveStep step = curve_step(at >> 1, at & 1, turn);
      quarters[turn][step.key] = {static_cast<std::uint8_t>(at), step.turn};
    }
  return quarters;
}
constexpr std::array<std::array<CurveStep, 4>, 4> quarters = make_quarters();

} // namespace

CurveSquare CurveSquare::quarter(unsigned k) const {
  const CurveStep step = quarters[turn][k];
  return {2 * x + (step.key >> 1), 2 * y + (step.key & 1U), level + 1, 4 * key + k, step.turn};
}

std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y, int level) {
  return curve_square(x, y, level).key;
}

CurveSquare curve_square(std::uint32_t x, std::uint32_t y, int level) {
  std::uint64_t key = 0;
  unsigned turn = 0;
  int bit = level;
  for (; bit % 4 != 0; --bit) {
    const CurveStep step = curve_step((x >> (bit - 1)) & 1, (y >> (bit - 1)) & 1, turn);
    key = (key << 2) | step.key;
    turn = step.turn;
  }
  for (; bit > 0; bit -= 4) {
    const CurveStep step = four_steps[turn][(((x >> (bit - 4)) & 15) << 4) | ((y >> (bit - 4)) & 15)];
    key = (key << 8) | step.key;
    turn = step.turn;
  }
  return {x, y, level, key, static_cast<std::uint8_t>(turn)};
}

} // namespace trime
