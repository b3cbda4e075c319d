// SPDX-License-Identifier: BSD-3-Clause
// A size field that is lowered around some places, as far as a gradation allows. Also how far simplified curves lie
// from those of a shape, in sizes: the one rule by which curves are made and judged.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/sizing/size_field.hpp"

#include <array>
#include <memory>
#include <vector>

namespace trime::sizing {

/// A place on a curve, its distance from the shape's curves, and h there.
struct CurveDistance {
  geometry::Vec2 place;
  double distance, size;

  double in_sizes() const { return distance / size; }
};

/// @brief That of a piece: at its start, which is where the one before ends, and in its middle. The size is not
/// checked. O(log of the pieces of the shape), thread-safe.
inline std::array<CurveDistance, 2> curve_distances(const geometry::Piece& piece, const geometry::PieceTree& shape,
                                                    const SizeField& asked, const geometry::Periods& periods) {
  const auto at_place = [&](geometry::Vec2 p) {
    return CurveDistance{p, shape.distance(p), asked.size(periods.wrap(p))};
  };
  return {at_place(piece.start), at_place(piece.point(0.5 * piece.length()))};
}

} // namespace trime::sizing

namespace trime::cones {
class ConeCells;
class ConeTree;
} // namespace trime::cones

namespace trime::sizing {

/// A place where the size must be at most a limit.
struct SizeLimit {
  geometry::Vec2 place;
  double size;
};

/// @brief min(field(x), min over limits k of size_k + gradation |x - place_k|), nearest images in a periodic container.
class LoweredSize final : public SizeField {
public:
  /// O(n log n) for n limits. @pre `field` outlives this object
  LoweredSize(const SizeField& field, const std::vector<SizeLimit>& limits, double gradation,
              const geometry::Periods& periods);
  LoweredSize(const SizeField&&, const std::vector<SizeLimit>&, double, const geometry::Periods&) = delete;
  ~LoweredSize() override;
  /// About 60 ns among a thousand limits. What is no valid size comes through as it is.
  double size(geometry::Vec2 p) const override;
  /// Does the same where the field is known to have a valid value.
  double lowered(geometry::Vec2 p, double field_size) const;
  bool is_uniform() const override { return false; }
  std::size_t memory_bytes() const override;

private:
  const SizeField& field_;
  geometry::Periods periods_;
  std::unique_ptr<const cones::ConeTree> cones_;
  std::unique_ptr<const cones::ConeCells> cells_;
};

} // namespace trime::sizing
