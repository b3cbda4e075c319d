// SPDX-License-Identifier: BSD-3-Clause
#include "app/run_report.hpp"

#include "app/run_limit.hpp"
#include "trime/record/describe.hpp"

#include <algorithm>
#include <cmath>

namespace trime::app {
namespace {

/// A count in full, any other value to six digits.
std::string value_text(double value) {
  return value == std::floor(value) && std::fabs(value) < 1e15 ? fmt::format("{:.0f}", value)
                                                               : fmt::format("{:.6g}", value);
}

/// Four decimals as long as that takes nine characters at most, so that columns stand.
std::string ratio_text(double ratio) {
  return std::fabs(ratio) < 1e4 ? fmt::format("{:.4f}", ratio) : fmt::format("{:.3e}", ratio);
}

std::string summary_line(const char* name, const mesh::RatioSummary& s) {
  return fmt::format("  {:<8}{:>9} {:>9} {:>9} {:>10} {:>9}\n", name, ratio_text(s.median), ratio_text(s.mean),
                     ratio_text(s.max), ratio_text(s.half_mean), ratio_text(s.std));
}

/// Area of the mesh and of the shape: they differ by what lies between chords and curve.
std::string area_text(const meshing::MeshResult& result) {
  const auto area = std::find_if(result.checks.begin(), result.checks.end(),
                                 [](const mesh::Check& check) { return check.name == "area"; });
  if (area == result.checks.end() || result.shape_area <= 0)
    return "";
  return fmt::format("Area of the mesh {:.9g}, of the shape {:.9g}: relative difference {:+.2e}\n\n", area->found,
                     result.shape_area, area->found / result.shape_area - 1);
}

/// How many points were asked for, if that is not what was made.
std::string count_text(const meshing::MeshResult& result) {
  const GlobalId made = result.mesh.point_slab.total;
  if (result.requested_points == 0 || (result.requested_points == made && result.count_reason.empty()))
    return "";
  return fmt::format("Points: {} asked for, {} made ({:.2f} %){}{}\n", result.requested_points, made,
                     100 * static_cast<double>(made) / static_cast<double>(result.requested_points),
                     result.count_reason.empty() ? "" : ": ", result.count_reason);
}

/// Returns what was done about features below the resolution.
std::string boundary_text(const meshing::MeshResult& result) {
  std::string text;
  for (const PlacedText& line : boundary::describe(result.features))
    text += "Boundary: " + line.formatted() + "\n";
  return text;
}

/// How to come from the mesh to the files of normalised contours.
std::string normalization_text(const std::vector<NormalizedPart>& normalized) {
  std::string text;
  for (const NormalizedPart& part : normalized)
    text +=
        fmt::format("Normalized: part '{0}', coordinates of {1} are (x - {2:.17g})/s and (y - {3:.17g})/s of those of "
                    "the mesh, s = {4:.17g}\n",
                    part.name, part.file, part.shift.x, part.shift.y, part.scale);
  return text;
}

std::string size_text(const SizeSummary& size) {
  return size.smallest == size.largest
             ? fmt::format("Size: {}; target edge length {:.6g}\n", size.description, size.largest)
             : fmt::format("Size: {}; target edge length from {:.6g} to {:.6g}\n", size.description, size.smallest,
                           size.largest);
}

std::string quality_text(const mesh::QualitySummary& q) {
  std::string text = "Quality    median      mean       max  half-mean       std   (1 is equilateral)\n";
  text += summary_line("alpha", q.alpha) + summary_line("beta", q.beta);
  text += fmt::format("  smallest angle {:.2f} degrees; worst triangle at {}\n", q.min_angle_degrees,
                      Place(q.worst_place, 10));
  text += fmt::format("  shortest edge {:.6g} at {}\n", q.shortest_edge, Place(q.shortest_place, 10));
  text += fmt::format("  edge length over wanted length: mean {:.4f}, std {:.4f}, largest {:.4g} at {}\n", q.size_mean,
                      q.size_std, q.longest_over_size, Place(q.longest_place, 10));
  if (q.growth.largest > 0)
    text +=
        fmt::format("  growth of the size per length: 90 % of the edges {:.3g}, 99 % {:.3g}, largest {:.3g} at {}\n",
                    q.growth.of_90_percent, q.growth.of_99_percent, q.growth.largest, Place(q.growth.place, 10));
  std::int64_t count = 0;
  for (const std::int64_t bin : q.alpha_histogram)
    count += bin;
  text += "  alpha from   triangles   share\n";
  for (std::size_t k = 0; k < q.alpha_histogram.size(); ++k)
    text += fmt::format(
        "  {:>10.2f}{:>12}{:>7.2f} %\n", mesh::RatioStatistics::histogram_edges[k], q.alpha_histogram[k],
        100 * static_cast<double>(q.alpha_histogram[k]) / static_cast<double>(std::max<std::int64_t>(count, 1)));
  return text;
}

/// The worst triangles with the corner that excuses each.
std::string bad_triangles_text(const mesh::QualitySummary& q) {
  if (q.worst_triangles.empty())
    return {};
  std::string text = fmt::format("Triangles with alpha above 2: {}; obtuse triangles: {}, {} of them near sharp "
                                 "corners; the worst of all these:\n",
                                 q.bad_triangles, q.obtuse_triangles, q.obtuse_at_corners);
  for (const mesh::BadTriangle& one : q.worst_triangles) {
    text += fmt::format("  {:>9} at {}: {}angle {:.4f} degrees, ", ratio_text(one.alpha), Place(one.place, 10),
                        one.obtuse ? "obtuse, " : "", one.largest_degrees);
    text += one.corner_degrees > 0
                ? fmt::format("at the corner {} of {:.3g} degrees\n", Place(one.corner, 10), one.corner_degrees)
                : "there is no sharp corner near it\n";
  }
  return text;
}

std::string cleanup_text(const cleanup::CleanupCounts& cleanup) {
  if (cleanup.patches == 0)
    return {};
  return fmt::format("Clean-up: {} of {} patches better; {} points moved, {} inserted, {} deleted ({} of all these on "
                     "the boundary); {} places where nothing helped\n",
                     cleanup.better, cleanup.patches, cleanup.moved, cleanup.inserted, cleanup.deleted,
                     cleanup.on_boundary, cleanup.left);
}

std::string checks_text(const mesh::Checks& checks) {
  std::string text = "Checks\n";
  std::size_t expected = 0, found = 0; // widths
  for (const mesh::Check& check : checks) {
    expected = std::max(expected, value_text(check.expected).size());
    found = std::max(found, value_text(check.found).size());
  }
  for (const mesh::Check& check : checks)
    text += fmt::format("  {:<7}{:<26} expected {:<{}} found {:<{}} {}\n", check.passed ? "ok" : "FAILED", check.name,
                        value_text(check.expected), expected, value_text(check.found), found, check.meaning);
  return text;
}

std::string traffic_line(const std::string& name, const CounterSpreads& counters, int ranks) {
  return fmt::format("  {:<18}{:>18.1f}{:>12.1f}{:>15}{:>13}\n", name,
                     static_cast<double>(counters[Counter::messages].sum) / ranks,
                     static_cast<double>(counters[Counter::bytes].sum) / 0x1p10 / ranks,
                     counters[Counter::collectives].max, counters[Counter::neighbours].max);
}

/// Returns what the ranks sent each other, by phase; nothing for one rank.
std::string traffic_text(const Measurements& measured) {
  if (measured.ranks == 1)
    return {};
  std::string text = "Traffic                  messages/rank    KiB/rank    collectives   neighbours\n";
  for (const Phase& phase : measured.phases)
    if (phase.counters[Counter::messages].sum > 0 || phase.counters[Counter::collectives].sum > 0)
      text += traffic_line(phase.name, phase.counters, measured.ranks);
  return text + traffic_line("total", measured.counters, measured.ranks);
}

/// The other counters of the whole run.
std::string counters_text(const Measurements& measured) {
  const bool several = measured.ranks > 1;
  std::string text =
      several ? "Counters                     all       min          mean       max  of a rank\n" : "Counters\n";
  for (std::size_t k = 0; k < counter_count; ++k) {
    const auto counter = static_cast<Counter>(k);
    const Spread& values = measured.counters[counter];
    if (is_traffic(counter) || values.sum == 0)
      continue;
    text += fmt::format("  {:<18}{:>12}", name_of(counter).name, values.sum);
    text += several ? fmt::format("{:>10}{:>14.1f}{:>10}\n", values.min, measured.mean(counter), values.max) : "\n";
  }
  return text;
}

std::string times_text(const Measurements& measured) {
  std::string text = "Time [s]                 min      mean       max    share\n";
  for (const Phase& phase : measured.phases)
    text += fmt::format("  {:<18}{:>8.3f}{:>10.3f}{:>10.3f}{:>7.1f} %\n", phase.name, phase.min, phase.mean, phase.max,
                        100 * phase.mean / std::max(measured.total, 1e-9));
  return text + fmt::format("  {:<18}{:>18.3f}{:>17.1f} %\n", "total", measured.total, 100.0);
}

} // namespace

SizeSummary summarize_size(std::string description, const mesh::DistributedMesh& mesh, const comm::Communicator& comm) {
  const record::SizeRange range = record::size_range(mesh, comm);
  return {std::move(description), range.smallest, range.largest};
}

int final_retriangulation(const meshing::MeshResult& result) {
  return result.triangulations + 1;
}

std::string run_report(const meshing::MeshResult& result, const SizeSummary& size, const Measurements& measured,
                       const io::WrittenFiles& files, const std::vector<NormalizedPart>& normalized) {
  const auto points = static_cast<double>(std::max<GlobalId>(result.mesh.point_slab.total, 1));
  std::string text = fmt::format("\n{} points, {} triangles, {} boundary edges\n", result.mesh.point_slab.total,
                                 result.mesh.triangle_slab.total, result.mesh.facet_slab.total);
  text += count_text(result) + size_text(size);
  if (!result.start_reason.empty())
    text += "Start: " + result.start_reason + "\n";
  text += fmt::format("Stopped after {} sweeps: {}\n", result.history.empty() ? 0 : result.history.back().sweep,
                      sweep::to_string(result.stop_reason));
  text += normalization_text(normalized) + boundary_text(result) + area_text(result) + cleanup_text(result.cleanup);
  text += quality_text(result.quality) + bad_triangles_text(result.quality) + "\n" + checks_text(result.checks) + "\n" +
          times_text(measured) + traffic_text(measured) + counters_text(measured);
  text += "Limit: " + run_limit(measured) + "\n";
  text += fmt::format("  {:.0f} points per second\n\n", points / std::max(measured.total, 1e-9));
  text += fmt::format("Memory     at most {:.1f} MiB per rank, {:.0f} bytes per point over all ranks\n",
                      static_cast<double>(measured.peak_memory) / 0x1p20,
                      static_cast<double>(measured.memory_sum) / points);
  text += fmt::format("Mesh hash  {:016x}\n", result.mesh.hash);
  for (std::size_t k = 0; k < files.paths.size(); ++k)
    text += fmt::format("{:<11}{}{}\n", k == 0 ? "Files" : "", files.paths[k],
                        k == 0 ? fmt::format("  ({:.1f} MiB)", static_cast<double>(files.bytes) / 0x1p20) : "");
  if (!files.paths.empty())
    text += "           draw it: scripts/plot_mesh.py " + files.paths[0] + "; or open it in ParaView\n";
  return text;
}

ExitCode exit_code(const meshing::MeshResult& result) {
  return is_complete(result) ? ExitCode::done : ExitCode::incomplete;
}

std::string incompleteness(const meshing::MeshResult& result, bool written) {
  std::string reason = "the sweep cap was reached, see meshing.max_sweeps";
  if (!mesh::all_passed(result.checks)) {
    reason = "failed checks:";
    for (const mesh::Check& check : result.checks)
      if (!check.passed)
        reason += " " + check.name;
  }
  return fmt::format("the mesh is NOT complete ({}){}; exit code 5", reason,
                     written ? "; the mesh file is marked as incomplete" : "");
}

} // namespace trime::app
