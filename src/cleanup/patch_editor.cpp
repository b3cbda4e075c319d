// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_editor.hpp"

#include "polygon/rules.hpp"

#include <cmath>

namespace trime::cleanup {
namespace {

using geometry::Vec2;
using polygon::BoundaryCurve;

} // namespace

bool PatchEditor::apply(Patch& trial, const PatchOperation& operation, double size) const {
  for (const LocalIndex v : operation.removed)
    if (v >= 0 && !remove(trial, v))
      return false;
  for (const LocalIndex v : operation.divided)
    if (v >= 0 && !divide(trial, v))
      return false;
  return !operation.inserted || insert(trial, *operation.inserted, size);
}

bool PatchEditor::insert(Patch& trial, Vec2 place, double size) const {
  const geometry::Lattice& lattice = start_.lattice();
  Vec2 p = lattice.snap(place);
  if (const auto chord = trial.entered_disc(p)) {
    p = lattice.snap(0.5 * (chord->a + chord->b) +
                     polygon::PolygonRules::push_way * geometry::left_normal(chord->b - chord->a));
    if (trial.entered_disc(p))
      return false;
  }
  return start_.has_room(p, size) && trial.add(p, size, {}, VertexRole::free) >= 0;
}

bool PatchEditor::remove(Patch& trial, LocalIndex v) const {
  const BoundaryVertex& own = trial.boundary[at(v)];
  if (trial.on_boundary(v)) {
    if (own.previous < 0 || own.next < 0 || start_.sites_of_loop(own.loop) < CleanupRules::least_in_loop)
      return false;
    trial.boundary[at(own.previous)].next = own.next;
    trial.boundary[at(own.previous)].changed = true;
    trial.boundary[at(own.next)].previous = own.previous;
    if (!chords_.stands_for_curve(trial, own.previous))
      return false;
  }
  trial.role[at(v)] = VertexRole::gone;
  --trial.gain;
  return trial.mesh.remove(v);
}

bool PatchEditor::divide(Patch& trial, LocalIndex before) const {
  const BoundaryVertex own = trial.boundary[at(before)];
  const LocalIndex after = own.next;
  if (after < 0)
    return false;
  const BoundaryCurve& curve = start_.curve();
  double end = trial.boundary[at(after)].arc;
  if (end <= own.arc)
    end += curve.length(own.loop);
  BoundaryVertex made{own.site, before, after, own.loop, 0.5 * (own.arc + end), own.tolerance, true};
  const BoundaryCurve::Strayed strayed = curve.strayed(own.loop, own.arc, end, trial.chord(before));
  if (strayed.bent && std::fabs(strayed.farthest - made.arc) < CleanupRules::most_off_middle * (end - own.arc))
    made.arc = strayed.farthest; // a corner that was left out
  const Vec2 p =
      start_.periods().nearest_image(start_.lattice().snap(curve.place(own.loop, made.arc).point), start_.center());
  if (made.arc >= curve.length(own.loop))
    made.arc -= curve.length(own.loop);
  const double h = 0.5 * (trial.size[at(before)] + trial.size[at(after)]);
  const LocalIndex v = start_.has_room(p, h) ? trial.add(p, h, made, VertexRole::free) : -1;
  if (v < 0)
    return false;
  trial.boundary[at(before)].next = v;
  trial.boundary[at(before)].changed = true;
  trial.boundary[at(after)].previous = v;
  return true;
}

} // namespace trime::cleanup
