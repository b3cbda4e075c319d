// SPDX-License-Identifier: BSD-3-Clause
#include "shape/marked_pieces.hpp"

#include "shape/part_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace trime::shape {
namespace {

using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

using Shifts = std::map<std::size_t, std::vector<Vec2>>; // of the images of parts, once they were asked for

/// Returns the marker of the segment of its part that a piece follows.
int marker_of(const Piece& piece, std::span<const Part> parts, const geometry::Frame& frame, Shifts& shifts) {
  const auto part = static_cast<std::size_t>(piece.part);
  const Polygon* polygon = part < parts.size() ? parts[part].as_polygon() : nullptr;
  if (polygon == nullptr || polygon->markers.empty())
    return 0;
  auto found = shifts.find(part);
  if (found == shifts.end())
    found = shifts.emplace(part, image_shifts(parts[part], frame)).first;
  int marker = 0;
  double least = HUGE_VAL;
  for (const Vec2 shift : found->second) {
    const geometry::SegmentGrid::Nearest nearest = polygon->grid.nearest(piece.point(piece.length() / 2) - shift);
    if (nearest.squared_distance < least) {
      least = nearest.squared_distance;
      marker = polygon->markers[static_cast<std::size_t>(nearest.segment)];
    }
  }
  return marker;
}

/// Returns the name in the file, or the marker itself.
std::string name_of(int part, int marker, std::span<const Part> parts) {
  const std::vector<std::string>& names = parts[static_cast<std::size_t>(part)].as_polygon()->marker_names;
  return names.empty() ? fmt::format("{}", marker) : names[static_cast<std::size_t>(marker - 1)];
}

} // namespace

bool have_markers(std::span<const Part> parts) {
  return std::any_of(parts.begin(), parts.end(), [](const Part& part) {
    return part.as_polygon() != nullptr && !part.as_polygon()->markers.empty();
  });
}

std::vector<std::int32_t> name_markers(geometry::Boundary& boundary, std::span<const Part> parts,
                                       const geometry::Frame& frame) {
  std::vector<std::int32_t> markers(boundary.part_names.size(), 0);
  if (!have_markers(parts))
    return markers;
  std::map<std::pair<int, int>, int> index_of; // by part and marker: in this order they are named
  std::vector<int> of_piece;                   // loop by loop
  Shifts shifts;
  for (const Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces)
      if (of_piece.push_back(marker_of(piece, parts, frame, shifts)); of_piece.back() != 0)
        index_of[{piece.part, of_piece.back()}] = 0;
  for (auto& [key, index] : index_of) {
    index = static_cast<int>(boundary.part_names.size());
    boundary.part_names.push_back(fmt::format("{}.{}", boundary.part_names[static_cast<std::size_t>(key.first)],
                                              name_of(key.first, key.second, parts)));
    markers.push_back(key.second);
  }
  for (std::size_t next = 0; Loop & loop : boundary.loops) {
    std::vector<int> given;
    for (Piece& piece : loop.pieces) {
      given.push_back(piece.part);
      if (const int marker = of_piece[next++]; marker != 0)
        piece.part = index_of.at({piece.part, marker});
    }
    for (std::size_t k = 0; k < given.size(); ++k) {
      const std::size_t before = (k + given.size() - 1) % given.size();
      if (given[before] == given[k] && loop.pieces[before].part != loop.pieces[k].part)
        loop.pieces[k].corner = true;
    }
  }
  return markers;
}

} // namespace trime::shape
