// SPDX-License-Identifier: BSD-3-Clause
// A vector whose new elements are not set: for large arrays that a loop over threads fills at once. Setting them first
// would touch all their memory twice, and by one thread.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace trime {

/// Like std::allocator, but elements made without a value hold whatever the memory held.
template <class T>
struct UnsetAllocator : std::allocator<T> {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  template <class U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };

  UnsetAllocator() = default;
  template <class U>
  UnsetAllocator(const UnsetAllocator<U>&) noexcept {}

  template <class U>
  void construct(U*) noexcept {} // allocated memory holds objects of such types already
  template <class U, class First, class... Rest>
  void construct(U* place, First&& first, Rest&&... rest) {
    ::new (static_cast<void*>(place)) U(std::forward<First>(first), std::forward<Rest>(rest)...);
  }
};

/// Elements made without a value, by resize or a constructor, must be written before they are read.
template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

/// Gives the memory of a vector back.
template <class Vector>
void release(Vector& list) {
  Vector().swap(list);
}

} // namespace trime
