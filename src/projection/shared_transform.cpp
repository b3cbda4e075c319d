// SPDX-License-Identifier: BSD-3-Clause
#include "projection/shared_transform.hpp"

#include "core/thread_loop.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <thread>
#include <vector>

namespace trime::projection {
namespace {

struct alignas(64) Slot {
  explicit Slot(const std::string& plane) : transform(lon_lat, plane) {}
  std::atomic_flag taken = ATOMIC_FLAG_INIT;
  Transform transform;
  geometry::Vec2 last_place{std::numeric_limits<double>::quiet_NaN(), 0}, last; ///< several fields ask for one place
};

} // namespace

struct DegreesOfPlane::Slots {
  std::vector<std::unique_ptr<Slot>> slots;

  Slot& take() const {
    static std::atomic<std::size_t> threads{0};
    thread_local const std::size_t home = threads.fetch_add(1, std::memory_order_relaxed);
    for (std::size_t k = home;; ++k) {
      Slot& slot = *slots[k % slots.size()];
      if (!slot.taken.test_and_set(std::memory_order_acquire))
        return slot;
      if (k - home >= slots.size())
        std::this_thread::yield();
    }
  }
};

DegreesOfPlane::DegreesOfPlane(const std::string& plane) : slots_(std::make_unique<Slots>()) {
  const std::size_t count =
      std::clamp<std::size_t>(std::max<std::size_t>(thread_count(), std::thread::hardware_concurrency()), 1, 256);
  for (std::size_t k = 0; k < count; ++k)
    slots_->slots.push_back(std::make_unique<Slot>(plane));
}

DegreesOfPlane::~DegreesOfPlane() = default;

geometry::Vec2 DegreesOfPlane::at(geometry::Vec2 place) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Slot& slot = slots_->take();
  if (!(slot.last_place == place)) {
    slot.last = slot.transform.undo(place).value_or(geometry::Vec2{none, none});
    slot.last_place = place;
  }
  const geometry::Vec2 result = slot.last;
  slot.taken.clear(std::memory_order_release);
  return result;
}

} // namespace trime::projection
