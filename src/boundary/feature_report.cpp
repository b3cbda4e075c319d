// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/feature_report.hpp"

#include "boundary/changed_bodies.hpp"
#include "boundary/loop_fates.hpp"
#include "boundary/rules.hpp"
#include "core/angle.hpp"
#include "polygon/both_sides.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace trime::boundary {
namespace {

using geometry::Vec2;
using polygon::BoundarySites;

/// Interior angle of the polygon of chords at site k, degrees.
double interior_angle(const BoundarySites& boundary, LocalIndex k) {
  const geometry::Segment out = boundary.chord(k),
                          in = boundary.chord(boundary.sites[static_cast<std::size_t>(k)].previous);
  const Vec2 ahead = out.b - out.a, back = in.a - in.b;
  const double angle = angle_of(cross(ahead, back), dot(ahead, back)) * (180 / pi);
  return angle < 0 ? angle + 360 : angle;
}

std::string counted(GlobalId count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// "a, b, c" of those that are not 0, or nothing.
struct Counted {
  GlobalId count;
  const char *one, *many;
};
std::string listed(std::initializer_list<Counted> items) {
  std::string text;
  for (const Counted& item : items)
    if (item.count > 0)
      text += (text.empty() ? "" : ", ") + counted(item.count, item.one, item.many);
  return text;
}

GlobalId loops_of_mesh(const FeatureReport& report) {
  std::vector<std::int32_t> tags;
  for (const LoopFate& fate : report.loops)
    tags.insert(tags.end(), fate.tags.begin(), fate.tags.end());
  std::sort(tags.begin(), tags.end());
  return std::unique(tags.begin(), tags.end()) - tags.begin();
}

/// One line for all that was done to the curves.
std::string simplification_line(const FeatureReport& report) {
  std::string line =
      listed({{report.cut, "narrow part cut", "narrow parts cut"},
              {report.closed, "narrow part of the outside closed", "narrow parts of the outside closed"},
              {report.widened, "widened", "widened"},
              {report.held, "narrow part kept because it joins or separates larger bodies",
               "narrow parts kept because they join or separate larger bodies"},
              {report.filled, "small hole filled", "small holes filled"},
              {report.thinned, "piece of ragged curves thinned", "pieces of ragged curves thinned"},
              {report.smoothed, "vertex of ragged curves smoothed", "vertices of ragged curves smoothed"}});
  if (!line.empty())
    line = fmt::format(
        "simplified to the size of the triangles: {}; {:.3g} % of the area of the shape was lost, {:.3g} % was added",
        line, 100 * report.lost_share, 100 * report.added_share);
  return line;
}

/// How many loops came to such an end.
GlobalId number_of(const FeatureReport& report, LoopFate::State state) {
  return std::count_if(report.loops.begin(), report.loops.end(),
                       [&](const LoopFate& fate) { return fate.state == state; });
}

/// Such as "1 component became 3 and 5 holes became 4", or nothing.
std::string changed_numbers(const FeatureReport& report) {
  std::string text;
  if (report.components != report.given_components)
    text = fmt::format("{} became {}", counted(report.given_components, "component", "components"), report.components);
  if (report.holes != report.given_holes)
    text += fmt::format("{}{} became {}", text.empty() ? "" : " and ", counted(report.given_holes, "hole", "holes"),
                        report.holes);
  return text;
}

/// Why the numbers have changed, the place and the width of the largest such part.
std::string reasons(const FeatureReport& report) {
  using State = LoopFate::State;
  std::string text;
  if (report.severed > 0)
    text = fmt::format("{} cut{}, the widest {:.2g} h at {}; meshing.connect = keep keeps {}",
                       counted(report.severed, "neck was", "necks were"), report.closed > 0 ? " or closed" : "",
                       report.widest_severed, Place(report.severed_place, 6), report.severed == 1 ? "it" : "them");
  const std::string lost = listed({{number_of(report, State::dropped), "loop was dropped", "loops were dropped"},
                                   {number_of(report, State::filled), "hole was filled", "holes were filled"},
                                   {number_of(report, State::merged), "loop was merged", "loops were merged"}});
  if (report.other_components > 0)
    text += fmt::format("{}{} left out as meshing.components asks for, {:.3g} % of the area", text.empty() ? "" : "; ",
                        counted(report.other_components, "component was", "components were"), 100 * report.other_share);
  if (!lost.empty())
    text += fmt::format("{}{}, the longest {:.2g} h around at {}", text.empty() ? "" : "; ", lost,
                        report.lost_perimeter, Place(report.lost_place, 6));
  if (const GlobalId split = number_of(report, State::split); split > 0)
    text += (text.empty() ? "" : "; ") + counted(split, "loop was split", "loops were split");
  return text;
}

/// The end of a warning, such as ", 2 of 3 loops are lost (1 dropped, 1 hole filled)", or nothing.
std::string lost_loops(const FeatureReport& report) {
  using State = LoopFate::State;
  const GlobalId dropped = number_of(report, State::dropped), filled = number_of(report, State::filled),
                 merged = number_of(report, State::merged), lost = dropped + filled + merged;
  if (lost == 0)
    return {};
  std::string text = fmt::format(", {} of {} {} lost ({})", lost, counted(std::ssize(report.loops), "loop", "loops"),
                                 lost == 1 ? "is" : "are",
                                 listed({{dropped, "dropped", "dropped"},
                                         {filled, "hole filled", "holes filled"},
                                         {merged, "merged with others", "merged with others"}}));
  if (merged > 0)
    text += fmt::format(" so that the mesh has {}", counted(loops_of_mesh(report), "loop", "loops"));
  return text;
}

/// The fates of all loops. Those of components that are left out on purpose are not lost.
std::vector<LoopFate> fates_of(const geometry::Boundary& given, const geometry::Boundary& meshed,
                               const std::vector<geometry::Loop>& others, const sizing::SizeField& asked,
                               const geometry::Lattice& lattice) {
  if (others.empty())
    return find_loop_fates(given, meshed, asked, lattice);
  geometry::Boundary all = meshed;
  all.loops.insert(all.loops.end(), others.begin(), others.end());
  std::vector<LoopFate> fates = find_loop_fates(given, all, asked, lattice);
  const auto is_other = [&](std::int32_t tag) {
    return std::any_of(others.begin(), others.end(), [tag](const geometry::Loop& loop) { return loop.tag == tag; });
  };
  for (LoopFate& fate : fates) {
    if (std::erase_if(fate.tags, is_other) == 0)
      continue;
    if (fate.tags.empty()) {
      fate.state = LoopFate::State::left_out;
      fate.remaining_length = fate.largest_deviation = fate.deviation = 0;
    } else if (fate.state == LoopFate::State::split && fate.tags.size() == 1) {
      fate.state = LoopFate::State::simplified;
    }
  }
  return fates;
}

/// Sets the place and the length of the longest loop that is lost.
void find_longest_lost(const geometry::Boundary& given, const sizing::SizeField& asked, FeatureReport& report) {
  double longest = 0;
  for (const LoopFate& fate : report.loops)
    if (fate.is_lost() && fate.length > longest) {
      longest = fate.length;
      report.lost_place = fate.place;
      report.lost_perimeter = longest / sizing::checked_size(asked, given.periods.wrap(fate.place));
    }
}

/// Is anything lost, added, cut or split, apart from the components that are left out on purpose?
bool loses_unasked(const FeatureReport& report) {
  return report.severed > 0 || report.components + report.other_components != report.given_components ||
         std::fmax(report.lost_share - report.other_share, report.added_share) > BoundaryRules::warned_loss ||
         std::any_of(report.loops.begin(), report.loops.end(),
                     [](const LoopFate& fate) { return fate.is_lost() || fate.state == LoopFate::State::split; });
}

} // namespace

FeatureReport report_features(const BoundarySites& boundary, std::span<const sizing::SizeLimit> limits,
                              const sizing::SizeField& asked) {
  FeatureReport report;
  report.dropped_islands = boundary.dropped.components;
  report.dropped_lakes = boundary.dropped.holes;
  report.dropped_area = boundary.dropped.area;
  report.dropped_share = boundary.dropped.share;
  report.corners_left_out = boundary.left_out;
  report.largest_deviation = boundary.deviation;
  report.segments_halved = boundary.halvings;
  report.size_limits = std::ssize(limits);
  for (const sizing::SizeLimit& limit : limits)
    report.lowest_size_share = std::fmin(report.lowest_size_share, limit.size / asked.size(limit.place));
  const BoundarySites sides = boundary.inner.empty() ? BoundarySites() : polygon::with_both_sides(boundary);
  const BoundarySites& all = boundary.inner.empty() ? boundary : sides; // angles at curves inside, too
  for (std::size_t k = 0; k < all.sites.size(); ++k)
    if (all.sites[k].corner)
      if (const double angle = interior_angle(all, static_cast<LocalIndex>(k)); angle < FeatureReport::sharp_angle)
        report.sharp_corners.push_back({all.sites[k].position, angle});
  std::stable_sort(report.sharp_corners.begin(), report.sharp_corners.end(),
                   [](const SharpCorner& a, const SharpCorner& b) { return a.degrees < b.degrees; });
  return report;
}

void report_losses(const geometry::Boundary& given, const geometry::Boundary& meshed,
                   const polygon::Simplification& simplified, const polygon::DroppedLoops& dropped,
                   const sizing::SizeField& asked, const geometry::Lattice& lattice, FeatureReport& report) {
  report.cut = simplified.cut;
  report.closed = simplified.closed;
  report.widened = simplified.widened;
  report.filled = simplified.filled;
  report.thinned = simplified.thinned;
  report.smoothed = simplified.smoothed;
  report.coarseness = simplified.coarseness;
  report.severed = simplified.severed;
  report.widest_severed = simplified.widest_severed * simplified.coarseness;
  report.severed_place = simplified.severed_place;
  report.held = simplified.held;
  const double change = dropped.change + dropped.others_area; // by small loops alone
  double lost = simplified.cut_area + 0.5 * (dropped.area - change) + dropped.others_area;
  double added = simplified.closed_area + 0.5 * (dropped.area + change);
  report.other_components = dropped.others;
  report.other_share = dropped.others_area / given.area;
  const double rest = meshed.area - given.area - (added - lost); // filled holes, thinned curves, moved sides
  (rest > 0 ? added : lost) += std::fabs(rest);
  const double twice = std::fmax(0, lost - given.area); // what one pass added, and a later one took away
  lost -= twice;
  added -= twice;
  report.given_components = given.components();
  report.given_holes = given.holes();
  report.components = meshed.components();
  report.holes = meshed.holes();
  report.given_area = given.area;
  report.lost_share = lost / given.area;
  report.added_share = added / given.area;
  report.loops = fates_of(given, meshed, dropped.other_loops, asked, lattice);
  measure_reach(given, meshed, report.loops);
  find_longest_lost(given, asked, report);
}

bool changes_topology(const FeatureReport& report) {
  return report.components != report.given_components || report.holes != report.given_holes ||
         std::any_of(report.loops.begin(), report.loops.end(),
                     [](const LoopFate& fate) { return fate.is_lost() || fate.state == LoopFate::State::split; });
}

PlacedText loss_warning(const FeatureReport& report, Occasion occasion) {
  if (!changes_topology(report) && !(std::fmax(report.lost_share, report.added_share) > BoundaryRules::warned_loss))
    return PlacedText("");
  std::string text = changed_numbers(report);
  if (const std::string why = reasons(report); !why.empty())
    text += (text.empty() ? "" : ": ") + why;
  text +=
      fmt::format("{}he shape is simplified at this size: {:.3g} % of its area is lost, {:.3g} % is added{}",
                  text.empty() ? "t" : ". T", 100 * report.lost_share, 100 * report.added_share, lost_loops(report));
  if (report.coarseness > BoundaryRules::told_coarseness)
    text +=
        fmt::format(". The simplification is that for triangles {:.2g} times as large: keeping more would take more "
                    "points than were asked for",
                    report.coarseness);
  if (loses_unasked(report)) {
    text += report.absolute_sizes
                ? ". Smaller sizes in [sizing] keep more, and --dry-run tries how much smaller ones keep everything. "
                : ". More points (a smaller edge_length) keep more, and --dry-run tries how many keep everything. ";
    if (report.components > report.given_components && report.severed == 0)
      text += "A smaller meshing.simplify_within keeps narrow connections. ";
    text += "meshing.keep_features = true keeps everything, however many points that takes";
  }
  if (occasion == Occasion::run)
    text += ". The table /trime_mpi/rings in the mesh file says what became of each loop";
  return PlacedText(text);
}

std::vector<PlacedText> describe(const FeatureReport& report) {
  constexpr std::size_t most_listed = 5;
  std::vector<PlacedText> lines;
  if (std::string line = simplification_line(report); !line.empty())
    lines.emplace_back(std::move(line));
  if (report.dropped_islands + report.dropped_lakes > 0)
    lines.emplace_back(fmt::format("{} and {} with a perimeter below {:g} local edge lengths were dropped; their share "
                                   "of the area of the shape is {:.3g}",
                                   counted(report.dropped_islands, "island", "islands"),
                                   counted(report.dropped_lakes, "lake", "lakes"), BoundaryRules::least_perimeter,
                                   report.dropped_share));
  if (report.corners_left_out > 0)
    lines.emplace_back(fmt::format("{} of features smaller than the triangles were left out, at most {:.2f} local edge "
                                   "lengths from the boundary of the mesh",
                                   counted(report.corners_left_out, "corner", "corners"), report.largest_deviation));
  if (report.segments_halved > 0)
    lines.emplace_back(fmt::format("{} halved, because another part of the boundary is near or the curve bends",
                                   counted(report.segments_halved, "boundary edge was", "boundary edges were")));
  if (report.size_limits > 0)
    lines.emplace_back(fmt::format("the size was lowered at {}, down to {:.2g} of the size asked for, because channels "
                                   "and corners there are narrower",
                                   counted(report.size_limits, "place", "places"), report.lowest_size_share));
  if (!report.sharp_corners.empty()) {
    std::string list;
    for (std::size_t k = 0; k < std::min(most_listed, report.sharp_corners.size()); ++k)
      list += fmt::format("{}{:.1f} at {}", k == 0 ? "" : ", ", report.sharp_corners[k].degrees,
                          Place(report.sharp_corners[k].place, 6));
    lines.emplace_back(
        fmt::format("{} of less than {:g} degrees, where the mesh must have triangles with such angles: {}{}",
                    counted(std::ssize(report.sharp_corners), "corner", "corners"), FeatureReport::sharp_angle, list,
                    report.sharp_corners.size() > most_listed ? ", ..." : ""));
  }
  return lines;
}

} // namespace trime::boundary
