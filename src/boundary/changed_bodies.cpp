// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/changed_bodies.hpp"

#include "boundary/feature_rule.hpp"
#include "boundary/rules.hpp"
#include "core/thread_loop.hpp"
#include "polygon/chord_curve.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace trime::boundary {
namespace {

using geometry::Boundary;
using geometry::Loop;
using polygon::BoundarySites;
using polygon::ChordCurve;

constexpr int vertices_in_a_row = 256; // by one thread

/// Largest distance of a vertex of the loop from the curves.
double reach_of(const Loop& loop, const geometry::PieceTree& curves) {
  PerThread<double> of_thread;
  thread_loop(std::ssize(loop.pieces), vertices_in_a_row, [&](std::ptrdiff_t k, int thread) {
    double& largest = of_thread[thread];
    largest = std::fmax(largest, curves.distance(loop.pieces[static_cast<std::size_t>(k)].start));
  });
  double largest = 0;
  for (const double of_one : of_thread)
    largest = std::fmax(largest, of_one);
  return largest;
}

/// A loop of the mesh as a polygon.
struct MeshLoop {
  double area = 0, length = 0; // the area is negative if the loop is around a hole
  double curve_area = 0;       // that of its curve
  double deviation = 0;        // largest distance of that from its chords
};

/// By tag. Bands are left out.
std::map<std::int32_t, MeshLoop> mesh_loops(const Boundary& meshed, const BoundarySites& polygon) {
  const auto sites = static_cast<LocalIndex>(polygon.sites.size());
  const std::vector<ChordCurve> chords = polygon::compare_chords(meshed, polygon, 0, sites);
  std::map<std::int32_t, MeshLoop> loops;
  for (std::size_t m = 0; m < meshed.loops.size(); ++m) {
    if (meshed.loops[m].winds())
      continue;
    MeshLoop& loop = loops[meshed.loops[m].tag];
    loop.curve_area = loop.area = enclosed_area(meshed.loops[m]);
    for (LocalIndex k = polygon.loop_start[m]; k < polygon.loop_start[m + 1]; ++k) {
      const ChordCurve& chord = chords[static_cast<std::size_t>(k)];
      const geometry::Segment edge = polygon.chord(k);
      loop.area -= chord.area;
      loop.length += length(edge.b - edge.a);
      loop.deviation = std::fmax(loop.deviation, chord.deviation);
    }
  }
  return loops;
}

/// Text such as "has 41.7 % more area in the mesh": all differences that are large.
std::string difference_text(const LoopFate& fate) {
  const double grown = fate.mesh_area / fate.area - 1, tip = fate.reach / fate.extent,
               away = fate.deviation * fate.mesh_length / (2 * fate.mesh_area);
  std::vector<std::string> parts;
  if (std::fabs(grown) > BoundaryRules::warned_area)
    parts.push_back(
        fmt::format("has {:.3g} % {} area in the mesh", 100 * std::fabs(grown), grown > 0 ? "more" : "less"));
  if (tip > BoundaryRules::warned_reach)
    parts.push_back(fmt::format("lost a tip that is {:.3g} % of its extent long", 100 * tip));
  if (away > BoundaryRules::warned_deviation)
    parts.push_back(fmt::format("is up to {:.3g} % of its mean width away from the mesh", 100 * away));
  return fmt::format("{}", fmt::join(parts, " and "));
}

} // namespace

void measure_reach(const Boundary& given, const Boundary& meshed, std::vector<LoopFate>& fates) {
  std::optional<geometry::PieceTree> curves;
  for (std::size_t k = 0; k < fates.size(); ++k) {
    geometry::Box box;
    for (const geometry::Piece& piece : given.loops[k].pieces)
      box.include(piece.start);
    fates[k].extent = length(box.max - box.min);
    if (fates[k].state != LoopFate::State::simplified && fates[k].state != LoopFate::State::split)
      continue;
    if (!curves)
      curves.emplace(meshed);
    fates[k].reach = reach_of(given.loops[k], *curves);
  }
}

double difference_of(const LoopFate& fate) {
  if (!(fate.area > 0) || fate.is_lost() || !(fate.mesh_area > 0))
    return 0;
  const double width = 2 * fate.mesh_area / fate.mesh_length;
  return std::max({std::fabs(fate.mesh_area / fate.area - 1) / BoundaryRules::warned_area,
                   fate.deviation / width / BoundaryRules::warned_deviation,
                   fate.extent > 0 ? fate.reach / fate.extent / BoundaryRules::warned_reach : 0});
}

void measure_bodies(const Boundary& meshed, const BoundarySites& polygon, const sizing::SizeField& asked,
                    FeatureReport& report) {
  const std::map<std::int32_t, MeshLoop> loops = mesh_loops(meshed, polygon);
  double added = 0;
  for (const auto& [tag, loop] : loops)
    if (loop.curve_area < 0)
      added += loop.area - loop.curve_area;
  report.hole_share = added / report.given_area;
  report.changed = {};
  double largest = 1;
  for (std::size_t k = 0; k < report.loops.size(); ++k) {
    LoopFate& fate = report.loops[k];
    fate.mesh_area = fate.mesh_length = 0;
    if (fate.area > 0 && !fate.is_lost())
      for (const std::int32_t tag : fate.tags)
        if (const auto found = loops.find(tag); found != loops.end()) {
          const MeshLoop& loop = found->second;
          fate.mesh_area += std::fabs(loop.area);
          fate.mesh_length += loop.length;
          fate.deviation = std::fmax(fate.deviation, loop.deviation);
        }
    const double difference = difference_of(fate);
    report.changed.number += difference > 1;
    if (difference > largest) {
      largest = difference;
      report.changed.worst = k;
      report.changed.perimeter = fate.length / sizing::checked_size(asked, meshed.periods.wrap(fate.place));
    }
  }
}

PlacedText body_warning(const FeatureReport& report, const std::vector<std::string>& part_names, Occasion occasion) {
  std::string text;
  if (report.changed.number > 0) {
    const LoopFate& fate = report.loops.at(report.changed.worst);
    text =
        fmt::format("{} of {} loops {} noticeably from the shape, measured by {} own size: {}that of part '{}' at {}, "
                    "{:.2g} h around, {}",
                    report.changed.number, report.loops.size(), report.changed.number == 1 ? "differs" : "differ",
                    report.changed.number == 1 ? "its" : "their", report.changed.number == 1 ? "" : "most of all, ",
                    part_names.at(static_cast<std::size_t>(fate.part)), Place(fate.place, 6), report.changed.perimeter,
                    difference_text(fate));
  }
  if (std::fabs(report.hole_share) > BoundaryRules::warned_loss)
    text += fmt::format("{}he mesh is {:.3g} % {} than the shape, since its edges are chords of the holes",
                        text.empty() ? "t" : ". T", 100 * std::fabs(report.hole_share),
                        report.hole_share > 0 ? "larger" : "smaller");
  if (text.empty())
    return PlacedText("");
  text += report.absolute_sizes ? ". Smaller sizes there follow the shape better"
                                : ". Smaller triangles there follow the shape better: more points, or a size that is "
                                  "smaller there (sizing.type = automatic or expression)";
  if (occasion == Occasion::run)
    text += ". The table /trime_mpi/rings in the mesh file has area and mesh_area of each loop";
  return PlacedText(text);
}

} // namespace trime::boundary
