// SPDX-License-Identifier: BSD-3-Clause
// A size field that is lowered around given places; a gradation limits how fast it grows from there.
#pragma once

#include "trime/geometry/periods.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <vector>

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
