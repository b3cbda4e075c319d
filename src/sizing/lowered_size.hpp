// SPDX-License-Identifier: BSD-3-Clause
// A size field that is lowered around given places. From there it grows with the distance, at most by a given
// gradation.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/sizing/size_field.hpp"

#include <array>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

namespace trime::sizing {

/// A place on a curve, its distance from the curves of the given shape, and h there.
struct CurveDistance {
  geometry::Vec2 place;
  double distance, size;

  double in_sizes() const { return distance / size; }
};

/// @brief Returns the distances of a piece from the shape, at its start and in its middle. The size is not checked.
/// Cost: O(log of the pieces of the shape). Thread-safe.
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
struct Cone;
} // namespace trime::cones

namespace trime::sizing {

/// A place at which the size must not exceed a limit.
struct SizeLimit {
  geometry::Vec2 place;
  double size;
};

/// Returns the cones of limits, with the periodic images next to the container. A nearest image is among them.
std::vector<cones::Cone> limiting_cones(const std::vector<SizeLimit>& limits, const geometry::Periods& periods);

/// Limits of a size, and how fast the size may grow from them.
struct GradedLimits {
  const std::vector<SizeLimit>& limits;
  double gradation;
};

/// @brief The size min(field(x), min over limits k of size_k + gradation |x - place_k|). There may be several sets of
/// limits with different gradations. In a periodic container, distances are those to the nearest periodic image.
class LoweredSize final : public SizeField {
public:
  /// Takes O(n log n) time for n limits.
  /// @pre `field` outlives this object
  LoweredSize(const SizeField& field, std::initializer_list<GradedLimits> sets, const geometry::Periods& periods);
  LoweredSize(const SizeField&&, std::initializer_list<GradedLimits>, const geometry::Periods&) = delete;
  ~LoweredSize() override;
  /// Returns the lowered size at p. Takes about 60 ns for a thousand limits. Invalid sizes of the field are returned
  /// unchanged.
  double size(geometry::Vec2 p) const override;
  void sizes(std::span<const geometry::Vec2> places, std::span<double> values) const override;
  bool prefers_blocks() const override { return field_.prefers_blocks(); }
  /// Returns the lowered size at p if the field is known to have the valid value `field_size` there.
  double lowered(geometry::Vec2 p, double field_size) const;
  bool is_uniform() const override { return false; }
  std::size_t memory_bytes() const override;

private:
  const SizeField& field_;
  geometry::Periods periods_;
  struct Set;
  std::vector<Set> sets_;
};

} // namespace trime::sizing
