// SPDX-License-Identifier: BSD-3-Clause
// Decides which chords of the boundary a trial may have.
#pragma once

#include "cleanup/patch_start.hpp"

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

} // namespace trime::cleanup
