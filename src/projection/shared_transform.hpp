// SPDX-License-Identifier: BSD-3-Clause
// A conversion between reference systems that threads may use at the same time.
#pragma once

#include "projection/projection.hpp"

#include <memory>
#include <string>

namespace trime::projection {

/// @brief Converts places of a plane to longitude and latitude. There are as many Transforms as threads, and each call
/// borrows one. Thread-safe.
class DegreesOfPlane {
public:
  /// @throws ConfigError if PROJ does not know the plane
  explicit DegreesOfPlane(const std::string& plane);
  ~DegreesOfPlane();
  DegreesOfPlane(const DegreesOfPlane&) = delete;
  DegreesOfPlane& operator=(const DegreesOfPlane&) = delete;

  /// Returns longitude and latitude; NaN where the projection is not defined. Takes about a microsecond.
  geometry::Vec2 at(geometry::Vec2 place) const;

private:
  struct Slots;
  std::unique_ptr<Slots> slots_;
};

} // namespace trime::projection
