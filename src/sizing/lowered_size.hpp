// SPDX-License-Identifier: BSD-3-Clause
// A size field that is lowered around given places; a gradation limits how fast it grows from there.
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

/// @brief Returns the distances of a piece at its start and in its middle. Does not check the size. O(log of the pieces
/// of the shape), thread-safe.
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

/// @brief The size min(field(x), min over limits k of size_k + gradation |x - place_k|), with the nearest images in a
/// periodic container.
class LoweredSize final : public SizeField {
public:
  /// O(n log n) for n limits. @pre `field` outlives this object
  LoweredSize(const SizeField& field, const std::vector<SizeLimit>& limits, double gradation,
              const geometry::Periods& periods);
  LoweredSize(const SizeField&&, const std::vector<SizeLimit>&, double, const geometry::Periods&) = delete;
  ~LoweredSize() override;
  /// Takes about 60 ns among a thousand limits. Invalid sizes of the field are returned unchanged.
  double size(geometry::Vec2 p) const override;
  /// As size(p), where the field is known to have the valid value `field_size`.
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
