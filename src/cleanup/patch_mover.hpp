// SPDX-License-Identifier: BSD-3-Clause
// Moves the sites of a patch: inner sites freely, sites on the boundary along their curve, as far as the boundary edges
// stay near the curve.
#pragma once

#include "cleanup/patch.hpp"
#include "trime/geometry/vec2.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief Checks the rule for boundary edges: the closed diametral disc of each edge is empty, and the curve that the
/// edge replaces does not leave this disc. A curve that turns by more than 60 degrees deviates from its edge by at most
/// the tolerance.
class PatchChords {
public:
  /// @pre `start` outlives the object
  explicit PatchChords(const PatchStart& start) : start_(start) {}

  /// @param longest_bent [h] largest length of edges that replace bent curves, see CleanupRules::bent_at_first
  void allow(double longest_bent) { longest_bent_ = longest_bent; }

  /// Returns whether an edge between two vertices on the boundary may replace the curve between them. @param size h at
  /// the edge
  bool stands_for_curve(const BoundaryVertex& from, const BoundaryVertex& to, const geometry::Segment& chord,
                        double size) const {
    double arc = to.arc - from.arc;
    if (arc < 0)
      arc += start_.curve().length(from.loop);
    const double length = geometry::length(chord.b - chord.a);
    return arc <= CleanupRules::straight_share * length || // the curve is a straight side
           stands_for_bent_curve(from, to, chord, size, arc, length);
  }
  /// Returns whether the boundary edge from vertex v to the next vertex may replace its curve.
  bool stands_for_curve(const Patch& patch, LocalIndex v) const {
    const BoundaryVertex& own = patch.boundary[at(v)];
    return stands_for_curve(own, patch.boundary[at(own.next)], patch.chord(v), patch.size[at(v)]);
  }

  /// @brief Returns whether each boundary edge that has changed is an edge of the triangulation, may replace the curve
  /// between its ends, and has no other vertex in its closed diametral disc. Also checks that no vertex has moved into
  /// the diametral disc of an unchanged boundary edge, and that no inner vertex lies outside the shape.
  bool hold(const Patch& patch) const;

private:
  bool stands_for_bent_curve(const BoundaryVertex& from, const BoundaryVertex& to, const geometry::Segment& chord,
                             double size, double arc, double length) const;
  bool holds(const Patch& patch, LocalIndex v, const PatchMesh::Apexes& apexes) const;
  bool wall_holds(const Patch& patch, LocalIndex u, LocalIndex w, const PatchMesh::Apexes& apexes) const;

  const PatchStart& start_;
  double longest_bent_ = CleanupRules::bent_at_first;
};

/// @brief Returns the sum of e^2 + w e^4 over the triangles (p, ring[k], ring[k+1]), where e = eta - 1 and w =
/// CleanupRules::quartic_weight. The measure eta = (a^2 + b^2 + c^2) / (4 sqrt(3) area) of a triangle with edges a, b,
/// c is 1 if the triangle is equilateral; eta is smooth and does not depend on the size of the triangle (Bank and Smith
/// 1997). The square improves the mean, and the fourth power gives the worst triangle most weight. Returns infinity if
/// a triangle is inverted or flat, or once the sum reaches `limit`.
/// @param closed true if the ring goes all around p, false if p lies on the boundary and the ring is open
double star_energy(geometry::Vec2 p, std::span<const geometry::Vec2> ring, bool closed, double limit = INFINITY);

/// The energy at p with its derivatives with respect to p. @pre no triangle is inverted or flat
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

/// @brief Lowers the energy of one star after the other by Newton steps. No site enters the diametral disc of a
/// boundary edge or comes near the rim of the patch.
class PatchMover {
public:
  /// The arguments must outlive the object.
  PatchMover(const PatchStart& start, const PatchChords& chords) : start_(start), chords_(chords) {}

  /// Sets whether moves are thorough: in that case steps along the boundary are halved more often if they do not lower
  /// the energy.
  void set_thorough(bool is_thorough) { is_thorough_ = is_thorough; }
  /// Makes angles near 90 degrees and above cost energy.
  void set_against_obtuse(bool is_against) { is_against_obtuse_ = is_against; }

  /// Makes one sweep over the vertices of a list that may move: first over those inside, without flips, then over those
  /// on the boundary.
  void relax(Patch& patch, std::span<const LocalIndex> vertices);

private:
  EnergyModel model_at(geometry::Vec2 p, bool closed) const;
  bool is_better(geometry::Vec2 p, bool closed, double limit) const;
  bool relax_inside(Patch& patch, LocalIndex v);
  void slide(Patch& patch, LocalIndex v);
  void slide_inside(Patch& patch, LocalIndex v);
  bool load_chords(const Patch& patch, LocalIndex v);
  geometry::Vec2 tangent_at(const Patch& patch, LocalIndex v) const;
  std::optional<geometry::Vec2> stepped(const Patch& patch, LocalIndex v, double step) const;
  static bool may_be_as_long(double before, double after, double size);
  bool may_slide_inside(const Patch& patch, LocalIndex v, geometry::Vec2 to) const;
  bool load_ring(const Patch& patch, LocalIndex v);
  bool load_fan(const Patch& patch, LocalIndex v);
  bool may_slide(const Patch& patch, LocalIndex v, const BoundaryVertex& moved, geometry::Vec2 to) const;
  bool keeps_clear(const Patch& patch, geometry::Vec2 to) const;
  bool leaves_discs_empty(const Patch& patch, LocalIndex v, geometry::Vec2 to) const;

  const PatchStart& start_;
  const PatchChords& chords_;
  bool is_thorough_ = false, is_against_obtuse_ = false;
  std::vector<LocalIndex> ring_, shifted_; // work space
  std::vector<geometry::Vec2> around_;     // positions of the vertices in ring_
  std::vector<LocalIndex> on_curve_;       // neighbours of a vertex along its curve inside
  geometry::Vec2 tangent_;                 // unit vector along that curve
};

} // namespace trime::cleanup
