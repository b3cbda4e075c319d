// SPDX-License-Identifier: BSD-3-Clause
// Lets several threads make one list together, in the order in which a single thread would make it.
#pragma once

#include "core/thread_loop.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace trime {

/// @brief Calls make(k, list) for k = 0 .. n-1, which may append to its list. Returns all lists joined, by rising k.
/// @param chunk how many successive k one thread takes
template <class Item, class Make>
std::vector<Item> gather_in_order(std::ptrdiff_t n, std::ptrdiff_t chunk, const Make& make) {
  std::vector<std::vector<Item>> lists(static_cast<std::size_t>((n + chunk - 1) / chunk));
  thread_loop(std::ssize(lists), 1, [&](std::ptrdiff_t c, int) {
    for (std::ptrdiff_t k = c * chunk; k < std::min(n, (c + 1) * chunk); ++k)
      make(k, lists[static_cast<std::size_t>(c)]);
  });
  if (lists.size() == 1)
    return std::move(lists.front());
  std::size_t size = 0;
  for (const std::vector<Item>& list : lists)
    size += list.size();
  std::vector<Item> all;
  all.reserve(size);
  for (const std::vector<Item>& list : lists)
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

} // namespace trime
