// SPDX-License-Identifier: BSD-3-Clause
// A size field that knows its values at many places, so that they are not computed again. It does not change any value.
#pragma once

#include "trime/sizing/size_field.hpp"

#include <span>
#include <vector>

namespace trime::sizing {

/// @brief The values of another field, which are kept for some places. The simplification asks for the size at each
/// vertex of a curve about ten times; a distance to 10^5 pieces takes 1 us each time, and a look into the table 30 ns.
class RememberedSize final : public SizeField {
public:
  /// @pre `field` outlives this object
  explicit RememberedSize(const SizeField& field) : field_(field) {}
  RememberedSize(const SizeField&&) = delete;

  /// @brief Computes the values at those places that are not known yet, and keeps them, also if they are not valid
  /// sizes. Uses all threads; no other thread may ask for a size at the same time. Does nothing for a uniform field.
  /// Memory: up to 128 bytes a place. Rethrows what the field throws; then no value of this call is kept.
  void remember(std::span<const geometry::Vec2> places);
  /// Returns the value of the field at p, bit for bit. Thread-safe.
  double size(geometry::Vec2 p) const override;
  void sizes(std::span<const geometry::Vec2> places, std::span<double> values) const override;
  bool prefers_blocks() const override { return field_.prefers_blocks(); }
  bool is_uniform() const override { return field_.is_uniform(); }
  double largest_growth() const override { return field_.largest_growth(); }
  bool jumps() const override { return field_.jumps(); }
  std::size_t memory_bytes() const override;

private:
  struct Slot {
    geometry::Vec2 place;
    double size;
    bool is_taken;
  };
  std::size_t slot_of(geometry::Vec2 p) const;
  void make_room(std::size_t more);

  const SizeField& field_;
  std::vector<Slot> slots_; // a power of two, or none; each place is in the first free slot from its hash on
  std::size_t taken_ = 0;
};

} // namespace trime::sizing
