// SPDX-License-Identifier: BSD-3-Clause
#include "shape/region_state.hpp"

#include "geometry/predicates.hpp"

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

RegionState::RegionState(const Region& region, std::size_t parts)
    : region_(region), parent_(region.nodes_.size(), -1), negates_(parent_.size(), 0), deciding_(parent_.size(), 0),
      values_(parent_.size(), 0), leaves_(parts), places_(parts, 0) {
  for (std::size_t k = parent_.size(); k-- > 0;) { // operands stand behind their operation
    const Region::Node& node = region_.nodes_[k];
    const int number = static_cast<int>(k);
    if (node.operation == Region::Operation::part) {
      leaves_[static_cast<std::size_t>(node.part)].push_back(number);
      continue;
    }
    for (const int operand : node.operands) {
      const auto o = static_cast<std::size_t>(operand);
      parent_[o] = number;
      negates_[o] = node.operation == Region::Operation::subtract && operand != node.operands[0] ? 1 : 0;
      deciding_[k] += is_deciding(operand) ? 1 : 0;
    }
    const bool decides = node.operation == Region::Operation::unite;
    values_[k] = (deciding_[k] > 0) == decides ? 1 : 0;
  }
}

/// Has the operand the value that decides its operation? One that is true decides a union, a false one the others.
bool RegionState::is_deciding(int node) const {
  const auto k = static_cast<std::size_t>(node);
  const bool decides = region_.nodes_[static_cast<std::size_t>(parent_[k])].operation == Region::Operation::unite;
  return ((values_[k] != 0) != (negates_[k] != 0)) == decides;
}

void RegionState::change(int part, bool inside) {
  for (const int leaf : leaves_[static_cast<std::size_t>(part)]) {
    bool value = inside;
    for (int node = leaf; node >= 0; node = parent_[static_cast<std::size_t>(node)]) {
      const auto k = static_cast<std::size_t>(node);
      ++looked_at_;
      if (node != leaf) {
        const bool decides = region_.nodes_[k].operation == Region::Operation::unite;
        value = (deciding_[k] > 0) == decides;
      }
      if (value == (values_[k] != 0))
        break;
      const bool has_parent = parent_[k] >= 0;
      const int before = has_parent && is_deciding(node) ? 1 : 0;
      values_[k] = value ? 1 : 0;
      if (has_parent)
        deciding_[static_cast<std::size_t>(parent_[k])] += (is_deciding(node) ? 1 : 0) - before;
    }
  }
}

} // namespace trime::shape
