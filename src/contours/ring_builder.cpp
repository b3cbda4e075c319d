// SPDX-License-Identifier: BSD-3-Clause
#include "contours/ring_builder.hpp"

#include "contours/contour_text.hpp"
#include "trime/core/error.hpp"

#include <algorithm>

namespace trime::contours {
namespace {

using geometry::Vec2;

constexpr int most_warnings = 5;

} // namespace

void RingBuilder::add(Vec2 p, int line, int marker) {
  check_coordinates(p, contour_.source, line, feature_);
  if (!ring_.points.empty() && ring_.points.back() == p) {
    warn(p, line);
    ring_.markers.back() = marker;
    return;
  }
  ring_.points.push_back(p);
  ring_.lines.push_back(line);
  ring_.markers.push_back(marker);
}

void RingBuilder::end_ring() {
  if (ring_.points.empty())
    return;
  if (ring_.points.size() > 1 && ring_.points.front() == ring_.points.back()) {
    ring_.points.pop_back();
    ring_.lines.pop_back();
    ring_.markers.pop_back();
  }
  if (const int distinct = distinct_vertices(); distinct < 3)
    throw GeometryError(fmt::format("{}:{}{}: the ring that starts here at ({}, {}) has {} distinct {}; expected at "
                                    "least 3",
                                    contour_.source, ring_.lines[0], feature_, ring_.points[0].x, ring_.points[0].y,
                                    distinct, distinct == 1 ? "vertex" : "vertices"));
  if (std::all_of(ring_.markers.begin(), ring_.markers.end(), [](int marker) { return marker == 0; }))
    ring_.markers = {};
  ring_.points.shrink_to_fit(); // they have grown by doubling
  ring_.lines.shrink_to_fit();
  ring_.markers.shrink_to_fit();
  contour_.rings.push_back(std::move(ring_));
  ring_ = {};
}

void RingBuilder::finish(const char* expected) {
  end_ring();
  if (contour_.rings.empty())
    throw GeometryError(fmt::format("{}: expected {}, found no vertex at all", contour_.source, expected));
  if (merged_ > most_warnings)
    contour_.warnings.push_back(
        fmt::format("{}: {} more repeated consecutive vertices merged", contour_.source, merged_ - most_warnings));
}

/// 1, 2, or 3 for three and more.
int RingBuilder::distinct_vertices() const {
  const std::vector<Vec2>& p = ring_.points;
  std::size_t other = 1;
  while (other < p.size() && p[other] == p[0])
    ++other;
  if (other >= p.size())
    return 1;
  for (std::size_t k = other + 1; k < p.size(); ++k)
    if (p[k] != p[0] && p[k] != p[other])
      return 3;
  return 2;
}

void RingBuilder::warn(Vec2 p, int line) {
  if (++merged_ <= most_warnings)
    contour_.warnings.push_back(fmt::format("{}:{}{}: vertex ({}, {}) repeats the one before it; the two are merged",
                                            contour_.source, line, feature_, p.x, p.y));
}

} // namespace trime::contours
