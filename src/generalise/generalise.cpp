// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/generalise.hpp"

#include "generalise/loop_builder.hpp"
#include "generalise/narrow_parts.hpp"
#include "generalise/rules.hpp"
#include "generalise/vertex_moves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace trime::generalise {
namespace {

using geometry::Vec2;

double area_of(const Triangulation& mesh, const NarrowPart& part) {
  double twice = 0;
  for (const LocalIndex t : part.triangles) {
    const Vec2 a = mesh.point(mesh.origin(3 * t));
    twice += cross(mesh.point(mesh.origin(3 * t + 1)) - a, mesh.point(mesh.origin(3 * t + 2)) - a);
  }
  return 0.5 * twice;
}

/// Is it more than roughness or a corner of the shape?
bool matters(const Triangulation& mesh, const NarrowPart& part) {
  if (part.lids.size() != 1)
    return true;
  const double lid = length(mesh.point(mesh.target(part.lids[0])) - mesh.point(mesh.origin(part.lids[0])));
  return !part.is_corner && part.depth > GeneraliseRules::least_depth * part.size && part.depth > lid;
}

} // namespace

std::unique_ptr<const Generalised> generalise(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                              const geometry::Lattice& lattice, Narrow narrow,
                                              std::span<const Vec2> inside) {
  if (boundary.periods.any() || boundary.loops.empty())
    return nullptr;
  CurveMap map(boundary, size, lattice);
  if (!map.is_valid())
    return nullptr;
  add_nodes_to_narrow_parts(map);
  const Triangulation& mesh = map.mesh();
  const std::vector<char> given = map.inside();
  std::vector<char> labels = given;
  auto result = std::make_unique<Generalised>();
  GeneralisedCounts& counts = result->counts;
  for (const NarrowPart& part : find_narrow_parts(map, given, true)) {
    if (part.holds_kept || !matters(mesh, part))
      continue;
    ++counts.cut;
    counts.cut_area += area_of(mesh, part);
    for (const LocalIndex t : part.triangles)
      labels[at(t)] = 0;
  }
  std::vector<NarrowPart> slits;
  for (NarrowPart& part : find_narrow_parts(map, given, false)) {
    if (part.holds_kept || !matters(mesh, part))
      continue;
    if (narrow == Narrow::keep) {
      slits.push_back(std::move(part));
      continue;
    }
    ++counts.closed;
    counts.closed_area += area_of(mesh, part);
    for (const LocalIndex t : part.triangles)
      labels[at(t)] = 1;
  }
  if (std::find(labels.begin(), labels.end(), 1) == labels.end())
    return nullptr; // all of it is narrow
  if (!separate_touching_loops(map, labels))
    return nullptr;
  if (std::getenv("GEN_DEBUG")) {
    for (const bool in : {true, false})
      for (const NarrowPart& part : find_narrow_parts(map, given, in))
        std::fprintf(stderr, "part in=%d tri=%zu lids=%zu depth/h=%g lid/h=%g corner=%d matters=%d at %g %g\n", in, part.triangles.size(), part.lids.size(), part.depth/part.size, part.lids.empty()?0:length(mesh.point(mesh.target(part.lids[0])) - mesh.point(mesh.origin(part.lids[0])))/part.size, part.is_corner, matters(mesh, part), mesh.point(mesh.origin(3*part.triangles[0])).x, mesh.point(mesh.origin(3*part.triangles[0])).y);
  }
  VertexMoves moves(map, labels, lattice);
  moves.widen(slits);
  counts.widened = std::ssize(slits);
  moves.merge_close_corners();
  counts.largest_move = moves.largest_share();
  if (labels == given && !moves.any())
    return nullptr;
  result->boundary = build_loops(map, labels, moves.any() ? moves.places() : MovedVertices{});
  if (const char* at_place = std::getenv("GEN_AT")) {
    double x, y, r;
    std::sscanf(at_place, "%lf,%lf,%lf", &x, &y, &r);
    for (LocalIndex v = 4; v < mesh.vertex_count(); ++v) {
      const Vec2 p = mesh.point(v), q = moves.places()[at(v)];
      if (std::fabs(p.x - x) < r && std::fabs(p.y - y) < r)
        std::fprintf(stderr, "V %d at %.7f %.7f to %.7f %.7f next %d h %g\n", v, p.x, p.y, q.x, q.y, map.next_on_curve(v), map.size(v));
    }
    for (LocalIndex t = 0; t < mesh.triangle_count(); ++t) {
      const Vec2 p = (1/3.0) * (mesh.point(mesh.origin(3*t)) + mesh.point(mesh.origin(3*t+1)) + mesh.point(mesh.origin(3*t+2)));
      if (std::fabs(p.x - x) < r && std::fabs(p.y - y) < r)
        std::fprintf(stderr, "T %d: %d %d %d given %d now %d\n", t, mesh.origin(3*t), mesh.origin(3*t+1), mesh.origin(3*t+2), given[at(t)], labels[at(t)]);
    }
  }
  if (std::getenv("GEN_DEBUG")) {
    std::vector<std::pair<Vec2, std::pair<int,int>>> all;
    for (int l = 0; l < std::ssize(result->boundary.loops); ++l)
      for (int k = 0; k < std::ssize(result->boundary.loops[l].pieces); ++k)
        all.push_back({result->boundary.loops[l].pieces[k].start, {l, k}});
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return lexicographically_less(a.first, b.first); });
    for (std::size_t k = 1; k < all.size(); ++k)
      if (all[k].first == all[k-1].first) std::fprintf(stderr, "DUP %.17g %.17g loop %d/%d of %zu piece %d/%d\n", all[k].first.x, all[k].first.y, all[k].second.first, all[k-1].second.first, result->boundary.loops[all[k].second.first].pieces.size(), all[k].second.second, all[k-1].second.second);
  }
  (void)inside;
  return result;
}

} // namespace trime::generalise
