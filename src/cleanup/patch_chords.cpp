// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_chords.hpp"

#include "geometry/diametral.hpp"

namespace trime::cleanup {

using geometry::Vec2;
using polygon::BoundaryCurve;

/// @param arc length of the curve between the ends @param length of the chord
bool PatchChords::stands_for_bent_curve(const BoundaryVertex& from, const BoundaryVertex& to,
                                        const geometry::Segment& chord, double size, double arc, double length) const {
  const BoundaryCurve::Strayed strayed = start_.curve().strayed(from.loop, from.arc, to.arc, chord);
  const bool tolerated = strayed.bent && strayed.deviation <= from.tolerance;
  if (strayed.leaves_disc || !(tolerated || (!strayed.sharp && arc <= CleanupRules::largest_arc_share * length)))
    return false;
  return strayed.deviation <= CleanupRules::unseen_stray * size || length <= longest_bent_ * size;
}

/// If a vertex lies in the disc of an edge of a Delaunay triangulation, the third vertex of one of its triangles does.
bool PatchChords::holds(const Patch& patch, LocalIndex v, const PatchMesh::Apexes& apexes) const {
  const BoundaryVertex& own = patch.boundary[at(v)];
  if (own.changed && !stands_for_curve(patch, v))
    return false;
  const auto [a, b] = patch.chord(v);
  for (const LocalIndex apex : {apexes.left, apexes.right}) {
    if (apex < PatchMesh::frame || !(own.changed || start_.has_changed(patch, apex)))
      continue; // near the rim, not all that lies between is known
    if ((apex == apexes.right && !patch.on_boundary(apex)) ||
        geometry::diametral_side(a, b, patch.mesh.position(apex)) <= 0)
      return false;
  }
  return true;
}

bool PatchChords::hold(const Patch& patch) const {
  LocalIndex missing = 0;
  for (const LocalIndex v : patch.rim) {
    const LocalIndex next = patch.boundary[at(v)].next;
    if (next < 0 || patch.is_gone(v))
      continue;
    const auto apexes = patch.mesh.apexes(v, next);
    if (!apexes)
      ++missing;
    else if (!holds(patch, v, *apexes))
      return false;
  }
  return missing <= start_.missing_chords();
}

} // namespace trime::cleanup
