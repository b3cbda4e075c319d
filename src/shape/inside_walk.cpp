// SPDX-License-Identifier: BSD-3-Clause
#include "shape/inside_walk.hpp"

#include "geometry/perturbed_side.hpp"

namespace trime::shape {

namespace {

constexpr LocalIndex crowd = 64;           // a bin with more segments is crowded
constexpr std::int64_t looks_for_tree = 8; // for each segment: about what the tree costs

} // namespace

bool InsideWalk::inside(geometry::Vec2 p) {
  const Polygon* polygon = part_->as_polygon();
  const LocalIndex most = polygon != nullptr ? polygon->grid.looked_at_for(p) : 0;
  if (most <= crowd)
    return part_->inside(p);
  const std::span<const geometry::Segment> segments = polygon->grid.segments();
  if (!tree_ && looked_at_ > looks_for_tree * std::ssize(segments))
    tree_.emplace(segments);
  std::optional<bool> found = tree_ && last_inside_ ? walked_to(p, most) : std::nullopt;
  if (!found) {
    looked_at_ += most;
    found = part_->inside(p);
  }
  last_ = p;
  last_inside_ = found;
  return *found;
}

/// Returns nothing if it would examine more than `most` segments.
std::optional<bool> InsideWalk::walked_to(geometry::Vec2 p, LocalIndex most) {
  const std::span<const geometry::Segment> segments = part_->as_polygon()->grid.segments();
  bool side = *last_inside_;
  LocalIndex looks = 0;
  tree_->for_each_near({last_, p}, [&](LocalIndex k) {
    side ^= geometry::crosses_way(segments[static_cast<std::size_t>(k)], last_, p);
    return ++looks < most;
  });
  looked_at_ += looks;
  return looks < most ? std::optional<bool>(side) : std::nullopt;
}

} // namespace trime::shape
