// SPDX-License-Identifier: BSD-3-Clause
// Moves the sites of a patch. Inner sites move freely, those on the boundary along their curve.
#pragma once

#include "cleanup/patch_chords.hpp"
#include "trime/geometry/vec2.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief Returns the sum of e^2 + w e^4 over the triangles (p, ring[k], ring[k+1]), where e = eta - 1 and w =
/// CleanupRules::quartic_weight. The quality eta = (a^2 + b^2 + c^2) / (4 sqrt(3) area) of the edges a, b, c is 1 for
/// an equilateral triangle, smooth, and without a scale (Bank and Smith 1997). The square improves the mean, and the
/// fourth power gives the worst triangle most weight. Returns infinity if a triangle is inverted or flat, or once the
/// sum reaches `limit`.
/// @param closed true if the ring is closed, false if it is the open fan of a vertex on the boundary
double star_energy(geometry::Vec2 p, std::span<const geometry::Vec2> ring, bool closed, double limit = INFINITY);

/// The energy with its derivatives with respect to p. @pre no triangle is inverted or flat
struct EnergyModel {
  double value = 0;
  geometry::Vec2 gradient;
  double xx = 0, xy = 0, yy = 0;
};
EnergyModel star_energy_model(geometry::Vec2 p, std::span<const geometry::Vec2> ring, bool closed);

/// Returns the Newton step if the model is convex, otherwise a step against the gradient; at most `limit` long.
geometry::Vec2 newton_step(const EnergyModel& model, double limit);

/// @brief Lowers the energy of one star after the other by Newton steps. No site enters the diametral disc of a chord
/// or comes near the rim of the patch.
class PatchMover {
public:
  /// The arguments must outlive the object.
  PatchMover(const PatchStart& start, const PatchChords& chords) : start_(start), chords_(chords) {}

  /// Makes moves thorough: then steps along the boundary are halved more often.
  void set_thorough(bool is_thorough) { is_thorough_ = is_thorough; }

  /// Makes one sweep over the free vertices of a list: first over those inside, without flips, then over those on the
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
  std::vector<geometry::Vec2> around_;     // positions of the ring
};

} // namespace trime::cleanup
