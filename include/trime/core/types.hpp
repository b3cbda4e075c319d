// SPDX-License-Identifier: BSD-3-Clause
// Integer types by role, and a vector for large arrays whose elements are not initialised. Ranks, threads and MPI
// counts are `int`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace trime {

using LocalIndex = std::int32_t; ///< index into an array on this rank
using GlobalId = std::int64_t;   ///< index into the whole mesh, over all ranks

/// Converts a local index to the index type of standard containers. @pre i >= 0
constexpr std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

/// An allocator that leaves new elements uninitialised unless a value is given, which saves a pass over large arrays.
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

/// A vector whose new elements are uninitialised: elements that resize or a constructor makes without a value must be
/// written before they are read.
template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

/// Empties a vector and frees its memory.
template <class Vector>
void release(Vector& list) {
  Vector().swap(list);
}

} // namespace trime
