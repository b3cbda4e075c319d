// SPDX-License-Identifier: BSD-3-Clause
// Decides which chords of the boundary are allowed in a trial.
#pragma once

#include "cleanup/patch_start.hpp"

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

} // namespace trime::cleanup
