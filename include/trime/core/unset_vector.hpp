// SPDX-License-Identifier: BSD-3-Clause
// A vector that does not initialise new elements, for large arrays that a thread loop fills at once. Initialising them
// first would touch all their memory twice, and from one thread.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace trime {

/// Like std::allocator, except that elements made without a value are not initialised.
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

/// Elements that resize or a constructor makes without a value must be written before they are read.
template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

/// Empties a vector and frees its memory.
template <class Vector>
void release(Vector& list) {
  Vector().swap(list);
}

} // namespace trime
