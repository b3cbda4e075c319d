// SPDX-License-Identifier: BSD-3-Clause
#include "projection/shared_transform.hpp"

#include "core/object_pool.hpp"

#include <limits>

namespace trime::projection {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A Transform with its last result: several fields ask for one place.
struct Slot {
  explicit Slot(const std::string& plane) : transform(lon_lat, plane) {}
  Transform transform;
  geometry::Vec2 last_place{none, none}, last;
};

} // namespace

struct DegreesOfPlane::Slots {
  ObjectPool<Slot> slots;
};

DegreesOfPlane::DegreesOfPlane(const std::string& plane) : slots_(std::make_unique<Slots>()) {
  slots_->slots.fill([](const Slot&) {}, plane);
}

DegreesOfPlane::~DegreesOfPlane() = default;

geometry::Vec2 DegreesOfPlane::at(geometry::Vec2 place) const {
  const ObjectPool<Slot>::Loan loan = slots_->slots.take();
  Slot& slot = *loan;
  if (!(slot.last_place == place)) {
    slot.last = slot.transform.undo(place).value_or(geometry::Vec2{none, none});
    slot.last_place = place;
  }
  return slot.last;
}

} // namespace trime::projection
