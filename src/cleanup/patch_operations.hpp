// SPDX-License-Identifier: BSD-3-Clause
// Insertions and deletions that may help a bad triangle.
#pragma once

#include "cleanup/patch_editor.hpp"

#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief Lists what may help the worst triangle, the most promising first.
class PatchOperations {
public:
  /// @param is_thorough deletions of all neighbours are tried, else of those inside with few neighbours
  void list(const Patch& now, const BadPlace& place, bool is_thorough);
  std::span<const PatchOperation> all() const { return all_; }

private:
  void add(const PatchOperation& operation);
  void add_insertion(geometry::Vec2 p) { add({.inserted = p}); }
  void add_removal(LocalIndex v) { add({.removed = {v, -1}}); }
  void list_at_boundary(const Patch& now, const BadPlace& place);
  void list_around(const Patch& now, const Corners& worst, LocalIndex v, bool is_thorough);

  std::vector<PatchOperation> all_;
  std::vector<LocalIndex> ring_; // work space
};

} // namespace trime::cleanup
