// SPDX-License-Identifier: BSD-3-Clause
// Moves the sites of a patch: freely inside, along their curve on the boundary, where only some chords are allowed.
#pragma once

#include "cleanup/patch.hpp"
#include "trime/geometry/vec2.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief The rule for chords: the closed diametral disc of each is empty, and none takes the place of a curve that
/// leaves this disc, or that turns by more than 60 degrees and strays by more than the tolerance.
class PatchChords {
public:
  /// The start must outlive the object.
  explicit PatchChords(const PatchStart& start) : start_(start) {}

  /// @param longest_bent in h: chords of curves may be that long, see CleanupRules::bent_at_first
  void allow(double longest_bent) { longest_bent_ = longest_bent; }

  /// May a chord between two vertices on the boundary replace the curve? @param size h there
  bool stands_for_curve(const BoundaryVertex& from, const BoundaryVertex& to, const geometry::Segment& chord,
                        double size) const {
    double arc = to.arc - from.arc;
    if (arc < 0)
      arc += start_.curve().length(from.loop);
    const double length = geometry::length(chord.b - chord.a);
    return arc <= CleanupRules::straight_share * length || // as on a straight side
           stands_for_bent_curve(from, to, chord, size, arc, length);
  }
  /// Does the same for the chord from vertex v to the next.
  bool stands_for_curve(const Patch& patch, LocalIndex v) const {
    const BoundaryVertex& own = patch.boundary[at(v)];
    return stands_for_curve(own, patch.boundary[at(own.next)], patch.chord(v), patch.size[at(v)]);
  }

  /// @brief Is each changed chord an edge that may replace its curve, with an empty closed disc? Also checks that no
  /// moved vertex has entered another disc, and that no inner vertex lies behind a chord.
  bool hold(const Patch& patch) const;

private:
  bool stands_for_bent_curve(const BoundaryVertex& from, const BoundaryVertex& to, const geometry::Segment& chord,
                             double size, double arc, double length) const;
  bool holds(const Patch& patch, LocalIndex v, const PatchMesh::Apexes& apexes) const;

  const PatchStart& start_;
  double longest_bent_ = CleanupRules::bent_at_first;
};

/// @brief Sum of e^2 + w e^4, e = eta - 1, w = CleanupRules::quartic_weight, over the triangles (p, ring[k],
/// ring[k+1]), eta = (a^2 + b^2 + c^2) / (4 sqrt(3) area) of the edges a, b, c: 1 for an equilateral triangle (Bank and
/// Smith 1997), smooth, without a scale. The square counts for the mean, the fourth power makes the worst triangle
/// rule. Infinity if a triangle is turned over or flat, or once the sum comes up to `limit`.
/// @param closed the ring is closed; else it is the open fan of a vertex on the boundary
double star_energy(geometry::Vec2 p, std::span<const geometry::Vec2> ring, bool closed, double limit = INFINITY);

/// Returns the energy with its derivatives by p. @pre no triangle is turned over or flat
struct EnergyModel {
  double value = 0;
  geometry::Vec2 gradient;
  double xx = 0, xy = 0, yy = 0;
};
EnergyModel star_energy_model(geometry::Vec2 p, std::span<const geometry::Vec2> ring, bool closed);

/// Newton's step where the model is convex, else down the gradient; not longer than `limit`.
geometry::Vec2 newton_step(const EnergyModel& model, double limit);

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
