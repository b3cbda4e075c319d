// SPDX-License-Identifier: BSD-3-Clause
// Insertions and deletions of sites that may improve a bad triangle.
#pragma once

#include "cleanup/patch_mover.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace trime::cleanup {

/// A change that may improve a bad triangle.
struct PatchOperation {
  std::array<LocalIndex, 2> removed{-1, -1}; ///< vertices that are removed
  std::array<LocalIndex, 2> divided{
      -1, -1}; ///< boundary edges that are divided, each named by the vertex at which it begins
  std::optional<geometry::Vec2> inserted = {}; ///< place of a new site inside
  bool inserts() const { return divided[0] >= 0 || inserted; }
  friend bool operator==(const PatchOperation&, const PatchOperation&) = default;
};

/// @brief Applies operations to a trial. After a method has returned false, the trial can no longer be used.
class PatchEditor {
public:
  /// The arguments must outlive the object.
  PatchEditor(const PatchStart& start, const PatchChords& chords) : start_(start), chords_(chords) {}

  /// @param size h at the place of a new site inside
  bool apply(Patch& trial, const PatchOperation& operation, double size) const;
  bool remove(Patch& trial, LocalIndex v) const;
  /// Inserts a site inside. If `place` lies in the disc of a boundary edge, as in the corner of a square, the site is
  /// moved out of it. Does not change the trial if there is no room.
  bool insert(Patch& trial, geometry::Vec2 place, double size) const;
  /// Divides the boundary edge that begins at a vertex, in its middle or at a corner that the edge left out.
  bool divide(Patch& trial, LocalIndex before) const;

private:
  const PatchStart& start_;
  const PatchChords& chords_;
};

/// @brief Divides all edges of the triangles that share a vertex with the bad triangle.
class PatchRefiner {
public:
  /// The arguments must outlive the object.
  PatchRefiner(const PatchChords& chords, const PatchEditor& editor) : chords_(chords), editor_(editor) {}

  /// @param now the patch @param trial a copy of `now`, which this method changes
  /// @return false if the division fails; then the trial can no longer be used
  bool refine(const Patch& now, Patch& trial, const BadPlace& place);

private:
  bool divide_around(const Patch& now, Patch& trial, const Corners& worst);
  bool divide_where_strayed(Patch& trial, LocalIndex most) const;
  bool divide_where_encroached(Patch& trial, LocalIndex most) const;
  bool is_behind(const Patch& trial, LocalIndex v);

  const PatchChords& chords_;
  const PatchEditor& editor_;
  std::vector<geometry::Vec2> middles_; // middles of inner edges
  std::vector<LocalIndex> ring_;        // work space
};

/// @brief Lists operations that may improve the worst triangle, the most promising first.
class PatchOperations {
public:
  /// @param is_thorough if true, the list contains the deletion of every neighbour; otherwise only of inner neighbours
  /// that have few neighbours
  void list(const Patch& now, const BadPlace& place, bool is_thorough);
  /// Adds operations against an obtuse triangle to the list: moves alone, and a site in the middle of each edge.
  void list_against_obtuse(const Patch& now, const BadPlace& place);
  std::span<const PatchOperation> all() const { return all_; }

private:
  void add(const PatchOperation& operation);
  void add_insertion(geometry::Vec2 p) { add({.inserted = p}); }
  void add_removal(LocalIndex v) { add({.removed = {v, -1}}); }
  void list_at_boundary(const Patch& now, const BadPlace& place);
  void divide_corner(const Patch& now, LocalIndex v, LocalIndex next, LocalIndex previous);
  void list_between_walls(const Patch& now, const Corners& worst);
  void list_around(const Patch& now, const Corners& worst, LocalIndex v, bool is_thorough);

  std::vector<PatchOperation> all_;
  std::vector<LocalIndex> ring_; // work space
};

} // namespace trime::cleanup
