// SPDX-License-Identifier: BSD-3-Clause
// Moves the sites of a patch: freely inside, along their curve on the boundary.
#pragma once

#include "cleanup/patch_chords.hpp"
#include "cleanup/star_energy.hpp"

#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief Moves lower the StarEnergy of one site after the other by Newton steps. No site enters the diametral disc of
/// a chord or comes near the rim of the patch.
class PatchMover {
public:
  /// References must outlive the object.
  PatchMover(const PatchStart& start, const PatchChords& chords) : start_(start), chords_(chords) {}

  /// Thorough moves halve steps along the boundary more often.
  void set_thorough(bool is_thorough) { is_thorough_ = is_thorough; }

  /// One sweep over those of the vertices that are free: first inside, with the edges as they are, then on the
  /// boundary.
  void relax(Patch& patch, std::span<const LocalIndex> vertices);

private:
  bool relax_inside(Patch& patch, LocalIndex v);
  void slide(Patch& patch, LocalIndex v);
  bool load_ring(const Patch& patch, LocalIndex v);
  bool load_fan(const Patch& patch, LocalIndex v);
  bool may_slide(const Patch& patch, LocalIndex v, const BoundaryVertex& moved, geometry::Vec2 to) const;
  bool keeps_clear(const Patch& patch, geometry::Vec2 to) const;
  bool leaves_discs_empty(const Patch& patch, LocalIndex v, geometry::Vec2 to) const;

  const PatchStart& start_;
  const PatchChords& chords_;
  bool is_thorough_ = false;
  std::vector<LocalIndex> ring_, shifted_; // work space
  std::vector<geometry::Vec2> around_;     // of the ring
};

} // namespace trime::cleanup
