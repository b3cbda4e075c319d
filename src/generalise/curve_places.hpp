// SPDX-License-Identifier: BSD-3-Clause
// Places along a curve, close to each other where other lines are near.
#pragma once

#include "generalise/rules.hpp"
#include "trime/geometry/boundary.hpp"

#include <cmath>
#include <cstddef>
#include <span>

namespace trime::generalise {

/// @brief Visits places along the pieces of a curve, from its start on. They are GeneraliseRules::whole_part h apart,
/// and GeneraliseRules::place_step h where other lines are near. The starts of all pieces are among them; the end of
/// the curve is not. Cost: as many calls of `visit` as there are places.
/// @param is_near is_near(p, reach, h) says whether a line that counts is near a part of the curve, which lies within
/// reach of p
/// @param visit visit(k, along) is called for the place on piece k that lies so far behind its start, and returns the
/// size h there, which is positive
/// @return false if the curve has more than most_places; then the rest is not visited
template <class IsNear, class Visit>
[[nodiscard]] bool visit_places(std::span<const geometry::Piece> pieces, IsNear&& is_near, Visit&& visit) {
  constexpr std::size_t most_places = 10'000'000; // along one curve
  std::size_t places = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const double whole = pieces[k].length();
    for (double along = 0; along < whole;) {
      double h = visit(k, along);
      const double next = std::fmin(whole, along + GeneraliseRules::whole_part * h);
      if (is_near(pieces[k].point(0.5 * (along + next)), 0.5 * (next - along), h))
        for (along += GeneraliseRules::place_step * h; along < next; along += GeneraliseRules::place_step * h) {
          if (++places > most_places)
            return false;
          h = visit(k, along);
        }
      if (++places > most_places)
        return false;
      along = next;
    }
  }
  return true;
}

} // namespace trime::generalise
