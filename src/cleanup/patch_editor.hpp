// SPDX-License-Identifier: BSD-3-Clause
// Insertions and deletions in a patch: how they are carried out.
#pragma once

#include "cleanup/patch_chords.hpp"

#include <array>
#include <optional>

namespace trime::cleanup {

/// A change that may help a bad triangle.
struct PatchOperation {
  std::array<LocalIndex, 2> removed{-1, -1};   ///< vertices
  std::array<LocalIndex, 2> divided{-1, -1};   ///< chords of the boundary, by the vertex where they begin
  std::optional<geometry::Vec2> inserted = {}; ///< inside
  bool inserts() const { return divided[0] >= 0 || inserted; }
  friend bool operator==(const PatchOperation&, const PatchOperation&) = default;
};

/// @brief Carries out operations on a trial. After a function returns false, the trial can no longer be used.
class PatchEditor {
public:
  /// References must outlive the object.
  PatchEditor(const PatchStart& start, const PatchChords& chords) : start_(start), chords_(chords) {}

  /// @param size h at the place, for new sites inside
  bool apply(Patch& trial, const PatchOperation& operation, double size) const;
  bool remove(Patch& trial, LocalIndex v) const;
  /// Inserts a site inside. In the disc of a chord it is pushed out of it, such as in the corner of a square. The trial
  /// stays as it is if there is no room.
  bool insert(Patch& trial, geometry::Vec2 place, double size) const;
  /// Divides the chord that begins at a vertex: in its middle, or at a corner that was left out.
  bool divide(Patch& trial, LocalIndex before) const;

private:
  const PatchStart& start_;
  const PatchChords& chords_;
};

} // namespace trime::cleanup
