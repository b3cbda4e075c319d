// SPDX-License-Identifier: BSD-3-Clause
// Smaller triangles around a bad one: the last resort where the boundary is too ragged for h.
#pragma once

#include "cleanup/patch_editor.hpp"

#include <vector>

namespace trime::cleanup {

/// @brief Divides all edges of the triangles that have a vertex of the bad one.
class PatchRefiner {
public:
  /// References must outlive the object.
  PatchRefiner(const PatchChords& chords, const PatchEditor& editor) : chords_(chords), editor_(editor) {}

  /// @param now the patch as it is @param trial a copy of it, which is changed
  /// @return false if it cannot be done; then the trial can no longer be used
  bool refine(const Patch& now, Patch& trial, const BadPlace& place);

private:
  bool divide_around(const Patch& now, Patch& trial, const Corners& worst);
  bool divide_where_strayed(Patch& trial, LocalIndex most) const;
  bool divide_where_encroached(Patch& trial, LocalIndex most) const;
  bool is_behind(const Patch& trial, LocalIndex v);

  const PatchChords& chords_;
  const PatchEditor& editor_;
  std::vector<geometry::Vec2> middles_; // of edges inside
  std::vector<LocalIndex> ring_;        // work space
};

} // namespace trime::cleanup
