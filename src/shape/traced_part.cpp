// SPDX-License-Identifier: BSD-3-Clause
#include "trime/shape/traced_part.hpp"

#include "shape/contour_polygon.hpp"
#include "shape/make_boundary.hpp"
#include "shape/vertex_table.hpp"
#include "tracing/curve_refiner.hpp"
#include "tracing/zero_chains.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/segment_grid.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::shape {
namespace {

using geometry::Box;
using geometry::Frame;
using geometry::length;
using geometry::Segment;
using geometry::SegmentGrid;
using geometry::Vec2;

// Fine cells have this share of the longer side of the container, unless the config says else.
constexpr double default_resolution = 1.0 / 512;
// [cells] Vertices so near to each other are one: rounding, or a node of the grid on the curve, made two.
constexpr double nearly_equal = 1e-3;
constexpr std::size_t fewest_vertices = 3;   // A closed chain of fewer vertices is not a loop.
constexpr std::size_t most_chains = 1 << 14; // [chains] Largest number for a formula: it bounds time and memory
// A piece of a contour at a periodic border finds its partner across within this share of the longer side.
constexpr double partner_reach = 1e-5;

/// @brief The part within the container, its vertices on opposite periodic sides at exactly the same places.
///
/// Each vertex on a lower side and its partner across differ by what the tracing is off, far less than 1e-5 of the
/// container's longer side.
/// @throws GeometryError if a vertex has no partner: the function is not periodic
contours::Contour clip_to_periods(const Part& traced, const geometry::Frame& frame);

using geometry::Boundary;
using geometry::Loop;
using geometry::Piece;

/// One periodic axis: coordinates along and across it.
struct Axis {
  double Vec2::*across;
  double Vec2::*along;
  double low, high;
  char name;
};

using Rings = std::vector<std::vector<Vec2>>;

/// Vertices within a few steps of a side are put onto it.
void straighten(Rings& rings, const Axis& axis, double reach) {
  for (std::vector<Vec2>& ring : rings)
    for (Vec2& p : ring)
      for (const double side : {axis.low, axis.high})
        if (std::fabs(p.*axis.across - side) <= reach)
          p.*axis.across = side;
}

/// Vertices of the rings on a side at which the curve enters or leaves it, by their place along it.
std::vector<Vec2*> ends_on(Rings& rings, const Axis& axis, double side) {
  std::vector<Vec2*> ends;
  for (std::vector<Vec2>& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 before = ring[(k + ring.size() - 1) % ring.size()], after = ring[(k + 1) % ring.size()];
      if (ring[k].*axis.across == side && (before.*axis.across != side || after.*axis.across != side))
        ends.push_back(&ring[k]);
    }
  std::sort(ends.begin(), ends.end(),
            [&](const Vec2* a, const Vec2* b) { return (*a).*axis.along < (*b).*axis.along; });
  return ends;
}

void join_sides(Rings& rings, const Axis& axis, double reach, const std::string& name) {
  const std::vector<Vec2*> low = ends_on(rings, axis, axis.low), high = ends_on(rings, axis, axis.high);
  for (std::size_t k = 0; k < std::max(low.size(), high.size()); ++k) {
    if (k < low.size() && k < high.size() && std::fabs((*low[k]).*axis.along - (*high[k]).*axis.along) <= reach) {
      (*high[k]).*axis.along = (*low[k]).*axis.along;
      continue;
    }
    const Vec2 alone = k < low.size() ? *low[k] : *high[k];
    throw GeometryError(
        fmt::format("part '{}': its boundary meets the side of the periodic container at {}, but not the opposite "
                    "side; expected a function with the period of the container in {}",
                    name, Place(alone), axis.name));
  }
}

/// Without vertices between two others on the same side: the other side need not have them.
void remove_inner_vertices(std::vector<Vec2>& ring, const Axis& axis) {
  std::vector<Vec2> kept;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 before = ring[(k + ring.size() - 1) % ring.size()], p = ring[k], after = ring[(k + 1) % ring.size()];
    const double side = p.*axis.across;
    if ((side != axis.low && side != axis.high) || before.*axis.across != side || after.*axis.across != side)
      kept.push_back(p);
  }
  ring = std::move(kept);
}

contours::Contour clip_to_periods(const Part& traced, const Frame& frame) {
  const Frame plain(frame.container());
  const std::vector<Part> parts{traced, Part::rectangle("container", frame.inner(), plain)};
  const std::array<std::string, 2> names{"traced", "container"};
  const geometry::Domain clipped = make_boundary(Region::parse("intersection(traced, container)", names), parts, plain);
  Rings rings;
  for (const Loop& loop : clipped.boundary().loops) {
    rings.emplace_back();
    for (const Piece& piece : loop.pieces)
      rings.back().push_back(piece.start);
  }
  const Box& box = frame.inner();
  const double reach = partner_reach * std::fmax(box.width(), box.height());
  std::vector<Axis> axes;
  if (frame.periods().x > 0)
    axes.push_back({&Vec2::x, &Vec2::y, box.min.x, box.max.x, 'x'});
  if (frame.periods().y > 0)
    axes.push_back({&Vec2::y, &Vec2::x, box.min.y, box.max.y, 'y'});
  for (const Axis& axis : axes)
    straighten(rings, axis, VertexTable::merge_steps * frame.step());
  for (const Axis& axis : axes) {
    for (std::vector<Vec2>& ring : rings)
      remove_inner_vertices(ring, axis);
    join_sides(rings, axis, reach, traced.name());
  }
  return contours::make_contour(rings, traced.name());
}

/// Without the vertices that follow another one too closely.
std::vector<Vec2> without_repeats(const std::vector<Vec2>& chain, double distance) {
  std::vector<Vec2> result;
  for (const Vec2 p : chain)
    if (result.empty() || length(p - result.back()) > distance)
      result.push_back(p);
  while (result.size() > 1 && length(result.front() - result.back()) <= distance)
    result.pop_back();
  return result;
}

/// The rings found so far, to see what they have already: in a tip narrower than a cell the grid sees islands, whose
/// curve is already in the refined ring of the whole.
class FoundRings {
public:
  explicit FoundRings(double distance) : distance_(distance) {}

  void add(const std::vector<Vec2>& ring) {
    Box box;
    std::vector<Segment> segments;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      box.include(ring[k]);
      segments.push_back({ring[k], ring[(k + 1) % ring.size()]});
    }
    const Vec2 margin{distance_, distance_};
    boxes_.push_back({box.min - margin, box.max + margin});
    grids_.emplace_back(std::move(segments));
  }

  /// Is every vertex of the chain on one of the rings? O(rings), and O(log) for each that may hold a vertex.
  bool hold(const std::vector<Vec2>& chain) const {
    for (std::size_t ring = 0; ring < boxes_.size(); ++ring)
      if (std::all_of(chain.begin(), chain.end(), [&](Vec2 p) {
            return boxes_[ring].contains(p) && grids_[ring].nearest(p, distance_).has_value();
          }))
        return true;
    return false;
  }

private:
  double distance_;
  std::vector<Box> boxes_;
  std::vector<SegmentGrid> grids_;
};

/// With fewer vertices a chain is what rounding makes around a node, smaller than the resolution by far.

/// Chains worth refining, the longest first.
std::vector<std::vector<Vec2>> without_specks(const tracing::ZeroChains& coarse, const std::string& name) {
  std::vector<std::vector<Vec2>> chains;
  for (const std::vector<Vec2>& chain : coarse.chains) {
    std::vector<Vec2> clean = without_repeats(chain, nearly_equal * coarse.cell);
    if (clean.size() >= fewest_vertices)
      chains.push_back(std::move(clean));
  }
  if (chains.size() > most_chains)
    throw GeometryError(fmt::format("part '{}': the function oscillates below the resolution of {:.3g} near ({:.9g}, "
                                    "{:.9g}), or has too many pieces: found {} closed curves, expected at most {}; "
                                    "leave out the smallest ones",
                                    name, 2 * coarse.cell, chains[most_chains][0].x, chains[most_chains][0].y,
                                    chains.size(), most_chains));
  std::stable_sort(chains.begin(), chains.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return chains;
}

double resolution_of(const std::string& name, double given, double side) {
  if (!std::isfinite(given) || given < 0)
    throw GeometryError(
        fmt::format("part '{}': expected a resolution > 0, or 0 for the default, found {}", name, given));
  return given > 0 ? given : default_resolution * side;
}

/// Closed rings, interior on the left; the same bits for any number of threads.
std::vector<std::vector<Vec2>> trace_zero_set(const std::string& name, const tracing::Shape& shape, const Frame& frame,
                                              double resolution) {
  const Box& box = frame.inner();
  const double side = std::fmax(box.width(), box.height());
  tracing::LevelFunction function(name, shape, box);
  const tracing::ZeroChains coarse = tracing::march(function, box, resolution_of(name, resolution, side));
  const tracing::TraceTolerances tolerances(side);
  tracing::CurveRefiner refiner(function, tolerances, 2 * coarse.cell);
  FoundRings found(4 * tolerances.chord);
  std::vector<std::vector<Vec2>> rings;
  for (const std::vector<Vec2>& chain : without_specks(coarse, name)) {
    if (found.hold(chain))
      continue;
    std::vector<Vec2> ring = refiner.refine(chain);
    if (ring.size() < 3)
      continue;
    found.add(ring);
    rings.push_back(std::move(ring));
  }
  return rings;
}

/// @throws GeometryError if the rings meet
Polygon traced_polygon(const std::string& name, const contours::Contour& rings, const Frame& frame) {
  std::vector<std::string> unused; // of vertices that the lattice made equal, and of pieces: both are fine here
  try {
    return make_contour_polygon(rings, {}, frame, unused);
  } catch (const GeometryError& error) {
    throw GeometryError(
        fmt::format("part '{}': its traced boundary is not a set of simple curves; expected curves that stay apart by "
                    "more than 1e-6 of the container (here vertices are numbered instead of lines: {})",
                    name, error.what()));
  }
}

std::vector<std::string> resolution_warnings(const std::string& name, const Frame& frame, double resolution) {
  const double finest = tracing::finest_resolution(std::fmax(frame.inner().width(), frame.inner().height()));
  if (!(resolution > 0 && resolution < finest))
    return {};
  return {fmt::format("part '{}': a resolution of {:g} is finer than {:g}, the finest there is for this container, "
                      "which is used instead",
                      name, resolution, finest)};
}

} // namespace

Part traced_part(const std::string& name, const tracing::Shape& shape, const Frame& frame, double resolution) {
  const contours::Contour contour = contours::make_contour(trace_zero_set(name, shape, frame, resolution), name);
  Part part = Part::polygon(name, traced_polygon(name, contour, frame), resolution_warnings(name, frame, resolution));
  if (!frame.periods().any())
    return part;
  return Part::polygon(name, traced_polygon(name, clip_to_periods(part, frame), frame), part.warnings());
}

} // namespace trime::shape
