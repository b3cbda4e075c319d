// SPDX-License-Identifier: BSD-3-Clause
// A size field that is raised around given places. From there the least size falls with the distance.
#pragma once

#include "cones/cone_tree.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace trime::sizing {

/// A place at which the size must be at least this large.
struct LeastSize {
  geometry::Vec2 place;
  double size;
};

/// @brief The size max(field(x), max over places k of size_k - gradation |x - place_k|). In a periodic container,
/// distances are those to the nearest periodic image.
class RaisedSize final : public SizeField {
public:
  /// Takes O(n) time for n places.
  /// @pre `field` outlives this object; there is at least one place
  RaisedSize(const SizeField& field, const std::vector<LeastSize>& places, double gradation,
             const geometry::Periods& periods);
  RaisedSize(const SizeField&&, const std::vector<LeastSize>&, double, const geometry::Periods&) = delete;
  /// Returns the raised size at p. An invalid size of the field is returned unchanged.
  double size(geometry::Vec2 p) const override { return raised(p, field_.size(p)); }
  void sizes(std::span<const geometry::Vec2> places, std::span<double> values) const override;
  bool prefers_blocks() const override { return field_.prefers_blocks(); }
  std::size_t memory_bytes() const override { return cones_.memory_bytes(); }

private:
  double raised(geometry::Vec2 p, double size) const;

  const SizeField& field_;
  geometry::Periods periods_;
  double largest_;        // size of all places
  cones::ConeTree cones_; // their heights are largest_ minus the sizes of the places
};

} // namespace trime::sizing
