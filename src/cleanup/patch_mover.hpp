// SPDX-License-Identifier: BSD-3-Clause
// Moves the sites of a patch: inner sites freely, those on the boundary along their curve, where only some chords are
// allowed.
#pragma once

#include "cleanup/patch.hpp"
#include "trime/geometry/vec2.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief The rule for chords: the closed diametral disc of each is empty, the curve that it replaces does not leave
/// this disc, and a curve that turns by more than 60 degrees deviates by at most the tolerance.
class PatchChords {
public:
  /// @pre `start` outlives the object
  explicit PatchChords(const PatchStart& start) : start_(start) {}

  /// @param longest_bent [h] largest length of chords of curves, see CleanupRules::bent_at_first
  void allow(double longest_bent) { longest_bent_ = longest_bent; }

  /// Returns whether a chord between two vertices on the boundary may replace the curve. @param size h there
  bool stands_for_curve(const BoundaryVertex& from, const BoundaryVertex& to, const geometry::Segment& chord,
                        double size) const {
    double arc = to.arc - from.arc;
    if (arc < 0)
      arc += start_.curve().length(from.loop);
    const double length = geometry::length(chord.b - chord.a);
    return arc <= CleanupRules::straight_share * length || // the curve is a straight side
           stands_for_bent_curve(from, to, chord, size, arc, length);
  }
  /// Returns the same for the chord from vertex v to the next.
  bool stands_for_curve(const Patch& patch, LocalIndex v) const {
    const BoundaryVertex& own = patch.boundary[at(v)];
    return stands_for_curve(own, patch.boundary[at(own.next)], patch.chord(v), patch.size[at(v)]);
  }

  /// @brief Returns whether each changed chord is an edge that may replace its curve and has an empty closed disc. Also
  /// checks that no moved vertex has entered another disc, and that no inner vertex lies behind a chord.
  bool hold(const Patch& patch) const;

private:
  bool stands_for_bent_curve(const BoundaryVertex& from, const BoundaryVertex& to, const geometry::Segment& chord,
                             double size, double arc, double length) const;
  bool holds(const Patch& patch, LocalIndex v, const PatchMesh::Apexes& apexes) const;

  const PatchStart& start_;
  double longest_bent_ = CleanupRules::bent_at_first;
};

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

/// @brief Returns the sum of w t^2 over the angles of the same triangles, where t is by how much the cotangent is below
/// CleanupRules::steep_cotangent, and w = CleanupRules::steep_weight. Angles far below 90 degrees cost nothing. @pre no
/// triangle is inverted or flat
double steep_energy(geometry::Vec2 p, std::span<const geometry::Vec2> ring, bool closed);
/// Adds this energy and its gradient to a model, and the convex part of its second derivatives.
void add_steep_energy(EnergyModel& model, geometry::Vec2 p, std::span<const geometry::Vec2> ring, bool closed);

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
  /// Makes angles near 90 degrees and above cost energy.
  void set_against_obtuse(bool is_against) { is_against_obtuse_ = is_against; }

  /// Makes one sweep over the free vertices of a list: first over those inside, without flips, then over those on the
  /// boundary.
  void relax(Patch& patch, std::span<const LocalIndex> vertices);

private:
  EnergyModel model_at(geometry::Vec2 p, bool closed) const;
  bool is_better(geometry::Vec2 p, bool closed, double limit) const;
  bool relax_inside(Patch& patch, LocalIndex v);
  void slide(Patch& patch, LocalIndex v);
  bool load_ring(const Patch& patch, LocalIndex v);
  bool load_fan(const Patch& patch, LocalIndex v);
  bool may_slide(const Patch& patch, LocalIndex v, const BoundaryVertex& moved, geometry::Vec2 to) const;
  bool keeps_clear(const Patch& patch, geometry::Vec2 to) const;
  bool leaves_discs_empty(const Patch& patch, LocalIndex v, geometry::Vec2 to) const;

  const PatchStart& start_;
  const PatchChords& chords_;
  bool is_thorough_ = false, is_against_obtuse_ = false;
  std::vector<LocalIndex> ring_, shifted_; // work space
  std::vector<geometry::Vec2> around_;     // positions of the ring
};

} // namespace trime::cleanup
