// SPDX-License-Identifier: BSD-3-Clause
// The smallest one of several size fields at each place.
#pragma once

#include "trime/sizing/size_field.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace trime::sizing {

/// The minimum of several sizes, such as one from the depth of the sea and one from the distance to the coast.
class MinimumSize final : public SizeField {
public:
  /// @pre at least one field; the fields outlive this object
  explicit MinimumSize(std::vector<const SizeField*> fields) : fields_(std::move(fields)) {}
  /// Returns the smallest size at p, or the first invalid one, so that the caller notices it.
  double size(geometry::Vec2 p) const override { return at(p).size; }
  void sizes(std::span<const geometry::Vec2> places, std::span<double> values) const override;
  bool prefers_blocks() const override;
  /// Returns the index of the field that is the smallest one at p; the first of several equal ones.
  std::size_t smallest_field(geometry::Vec2 p) const { return at(p).field; }
  /// @brief Sets fields[k] to smallest_field(places[k]), and values[k] to the size of that field.
  /// @pre the three lists are equally long
  void smallest_fields(std::span<const geometry::Vec2> places, std::span<std::size_t> fields,
                       std::span<double> values) const;
  bool jumps() const override;
  std::size_t memory_bytes() const override;

private:
  struct Smallest {
    std::size_t field;
    double size;
  };
  Smallest at(geometry::Vec2 p) const;

  std::vector<const SizeField*> fields_;
};

} // namespace trime::sizing
