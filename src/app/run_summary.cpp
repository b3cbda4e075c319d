// SPDX-License-Identifier: BSD-3-Clause
#include "app/run_summary.hpp"

#include <algorithm>
#include <initializer_list>

namespace trime::app {
namespace {

constexpr std::size_t most_names = 8; // parts of the boundary in the line of names

std::string counted(std::int64_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// One line. A line without text is left out.
std::string line(const char* word, const std::string& text) {
  return text.empty() ? text : fmt::format("\n{:<11}{}", word, text);
}

std::string topology(int pieces, int holes) {
  return counted(pieces, "piece", "pieces") + ", " + counted(holes, "hole", "holes");
}

std::string start_text(const Provenance& p) {
  return fmt::format("{}, {} x {} on {}", p.line.config, counted(p.placement.ranks, "rank", "ranks"),
                     counted(p.placement.threads, "thread", "threads"), counted(p.placement.nodes, "node", "nodes"));
}

std::string shape_text(const Provenance& p) {
  return fmt::format("area {:.6g}, boundary length {:.6g}; {}{}", p.boundary.area, p.boundary.length(),
                     topology(p.boundary.components(), p.boundary.holes()),
                     p.map.crs.empty() ? "" : "; coordinates in " + name_of(p.map));
}

std::string mesh_text(const meshing::MeshResult& result) {
  const mesh::DistributedMesh& mesh = result.mesh;
  std::string text =
      fmt::format("{} points, {} triangles, {} boundary edges; {}", mesh.point_slab.total, mesh.triangle_slab.total,
                  mesh.facet_slab.total, topology(result.components, result.holes));
  if (result.requested_points != 0 && result.requested_points != mesh.point_slab.total)
    text += fmt::format("; {} points were asked for{}{}", result.requested_points,
                        result.count_reason.empty() ? "" : ": ", result.count_reason);
  return text;
}

std::string size_text(const SizeSummary& size, const mesh::GrowthSummary& growth) {
  const std::string lengths = size.smallest == size.largest
                                  ? fmt::format("{:.6g}", size.largest)
                                  : fmt::format("from {:.6g} to {:.6g}", size.smallest, size.largest);
  std::string text = fmt::format("{}; target edge length {}", size.description, lengths);
  constexpr double least_growth = 5e-4; // a smaller one is that of rounding, or nothing that a user would see
  if (growth.largest >= least_growth)
    text += fmt::format(", which grows by {:.3g} per length (99 % of the edges; at most {:.3g})", growth.of_99_percent,
                        growth.largest);
  return text;
}

std::string quality_text(const mesh::QualitySummary& q) {
  std::string text =
      fmt::format("alpha median {:.4f}, mean {:.4f}, worst {:.4g} at {}; smallest angle {:.2f} degrees", q.alpha.median,
                  q.alpha.mean, q.alpha.max, Place(q.worst_place, 10), q.min_angle_degrees);
  if (q.bad_triangles > 0)
    text += fmt::format("; {} with alpha above 2", counted(q.bad_triangles, "triangle", "triangles"));
  if (q.obtuse_triangles > 0)
    text += fmt::format("; {}", counted(q.obtuse_triangles, "obtuse triangle", "obtuse triangles"));
  return text;
}

/// The shortest edge, which limits the time step of many solvers.
std::string shortest_text(const mesh::QualitySummary& q) {
  return fmt::format("edge of length {:.6g} at {}", q.shortest_edge, Place(q.shortest_place, 10));
}

/// Counts the features of the boundary that the run changed.
std::string boundary_text(const boundary::FeatureReport& report) {
  struct Change {
    GlobalId count;
    const char *one, *many;
  };
  std::string text;
  for (const auto& [count, one, many] :
       std::initializer_list<Change>{{report.cut, "narrow part cut", "narrow parts cut"},
                                     {report.closed, "gap closed", "gaps closed"},
                                     {report.widened, "gap widened", "gaps widened"},
                                     {report.filled, "small hole filled", "small holes filled"},
                                     {report.dropped_islands, "island dropped", "islands dropped"},
                                     {report.dropped_lakes, "lake dropped", "lakes dropped"},
                                     {report.corners_left_out, "corner left out", "corners left out"},
                                     {report.size_limits, "place with a smaller size", "places with a smaller size"},
                                     {std::ssize(report.sharp_corners), "sharp corner", "sharp corners"}})
    if (count > 0)
      text += (text.empty() ? "" : ", ") + counted(count, one, many);
  std::string area;
  if (report.lost_share > 0)
    area += fmt::format(" -{:.3g} %", 100 * report.lost_share);
  if (report.added_share > 0)
    area += fmt::format(" +{:.3g} %", 100 * report.added_share);
  if (!area.empty())
    text += fmt::format("{}area{}", text.empty() ? "" : "; ", area);
  return text;
}

/// @param edges by part, then by curve
std::string names_text(const record::Origin& origin, const std::vector<std::int64_t>& edges) {
  std::vector<std::string> names = origin.part_names;
  names.insert(names.end(), origin.curve_names.begin(), origin.curve_names.end());
  std::string text;
  std::size_t named = 0, all = 0;
  for (std::size_t part = 0; part < edges.size(); ++part)
    if (edges[part] > 0 && ++all <= most_names)
      text += fmt::format("{}{} {}", named++ == 0 ? "edges of " : ", ", names.at(part), edges[part]);
  return all == named ? text : text + fmt::format(", and {} more names", all - named);
}

/// The regions that have triangles, in the order of their numbers.
std::string regions_text(const std::vector<std::string>& names, const std::vector<meshing::RegionSummary>& regions) {
  std::string text;
  std::size_t named = 0, all = 0;
  for (std::size_t k = 0; k < regions.size(); ++k)
    if (regions[k].triangles > 0 && ++all <= most_names)
      text += fmt::format("{}{} {}", named++ == 0 ? "triangles of " : ", ", names.at(k), regions[k].triangles);
  return all == named ? text : text + fmt::format(", and {} more regions", all - named);
}

/// Says what the regions lost to each other, one line for each pair and reason, the largest first.
std::string losses_text(const std::vector<std::string>& names, std::vector<geometry::RegionLoss> losses) {
  std::stable_sort(losses.begin(), losses.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  std::string text;
  for (std::size_t k = 0; k < std::min(losses.size(), most_names); ++k) {
    const geometry::RegionLoss& loss = losses[k];
    const std::string places =
        loss.count == 1 ? "" : fmt::format(", {} places, the largest of {:.3g}", loss.count, loss.largest);
    text += fmt::format("{}{} to {}: {:.3g} ({}{}) at {}", k > 0 ? "\n           " : "",
                        names.at(static_cast<std::size_t>(loss.loser)), names.at(static_cast<std::size_t>(loss.winner)),
                        loss.area, geometry::name_of(loss.reason), places, Place(loss.place, 6));
  }
  if (losses.size() > most_names)
    text += fmt::format("\n           and {} smaller ones, see 'trime_mpi info'", losses.size() - most_names);
  return text;
}

std::string checks_text(const mesh::Checks& checks) {
  const auto passed =
      std::count_if(checks.begin(), checks.end(), [](const mesh::Check& check) { return check.passed; });
  std::string text = fmt::format("{} of {} passed", passed, checks.size());
  for (const mesh::Check& check : checks)
    if (!check.passed)
      text += fmt::format("; {} FAILED: expected {:.6g}, found {:.6g}", check.name, check.expected, check.found);
  return text;
}

/// Total seconds, and the two phases that took most of them.
std::string time_text(const Measurements& measured) {
  std::vector<Phase> phases = measured.phases;
  std::stable_sort(phases.begin(), phases.end(), [](const Phase& a, const Phase& b) { return a.mean > b.mean; });
  std::string text = fmt::format("{:.2f} s", measured.total);
  for (std::size_t k = 0; k < std::min<std::size_t>(2, phases.size()); ++k)
    text += fmt::format("{}{} {:.0f} %", k == 0 ? ": " : ", ", phases[k].name,
                        100 * phases[k].mean / std::max(measured.total, 1e-9));
  return text + fmt::format("; memory at most {:.0f} MiB per rank", static_cast<double>(measured.peak_memory) / 0x1p20);
}

/// The files: those that begin as the first one are shortened to their endings.
std::string files_text(const io::WrittenFiles& files) {
  if (files.paths.empty())
    return {};
  const std::string stem = files.paths[0].substr(0, files.paths[0].rfind('.'));
  std::string text = files.paths[0];
  for (std::size_t k = 1; k < files.paths.size(); ++k)
    text += " " + (files.paths[k].starts_with(stem + ".") ? files.paths[k].substr(stem.size()) : files.paths[k]);
  return text + fmt::format("  ({:.1f} MiB)", static_cast<double>(files.bytes) / 0x1p20);
}

} // namespace

std::vector<std::int64_t> edges_of_parts(const mesh::DistributedMesh& mesh, std::size_t parts, std::size_t curves,
                                         const comm::Communicator& comm) {
  std::vector<std::int64_t> edges(parts + curves);
  for (const std::int32_t part : mesh.facet_parts)
    ++edges.at(static_cast<std::size_t>(part));
  for (const std::int32_t curve : mesh.curve_numbers)
    ++edges.at(parts + static_cast<std::size_t>(curve));
  comm.sum(edges);
  return edges;
}

std::string run_summary(const RunFacts& facts) {
  const meshing::MeshResult& result = facts.result;
  const int sweeps = result.history.empty() ? 0 : result.history.back().sweep;
  std::string text =
      line("Run", start_text(facts.provenance)) + line("Shape", shape_text(facts.provenance)) +
      line("Mesh", mesh_text(result)) + line("Size", size_text(facts.size, facts.result.quality.growth)) +
      line("Quality", quality_text(result.quality)) + line("Shortest", shortest_text(result.quality)) +
      line("Boundary", boundary_text(result.features)) +
      line("Names", names_text(facts.provenance.origin, facts.part_edges)) +
      line("Regions", regions_text(facts.provenance.origin.regions.names, result.regions)) +
      line("Losses", losses_text(facts.provenance.origin.regions.names, result.region_losses)) +
      line("Sweeps", fmt::format("{}: {}", sweeps, sweep::to_string(result.stop_reason))) +
      line("Checks", checks_text(result.checks)) + line("Mesh hash", fmt::format("{:016x}", result.mesh.hash)) +
      line("Time", time_text(facts.measured)) + line("Files", files_text(facts.files));
  if (!facts.files.paths.empty())
    text += line("More", fmt::format("'trime_mpi info {0}' prints all numbers, 'plot_mesh.py {0}' draws the mesh",
                                     facts.files.paths[0]));
  return text.substr(1);
}

} // namespace trime::app
