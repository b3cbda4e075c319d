// SPDX-License-Identifier: BSD-3-Clause
#include "formats/mesh_series.hpp"

#include "comm/agree.hpp"
#include "formats/cell_arrays.hpp"
#include "formats/output_files.hpp"
#include "io/extra_arrays.hpp"
#include "io/id_bytes.hpp"
#include "io/temporary_file.hpp"
#include "io/xdmf.hpp"
#include "trime/core/error.hpp"
#include "trime/io/mesh_file.hpp"

#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>
#include <span>
#include <string>

namespace trime::formats {
namespace {

/// A file and the time at which it is shown.
struct NamedTime {
  std::string file; ///< relative to the directory of the series
  int time = 0;
};

/// Text of NAME.vtkhdf.series. Bytes of a name that UTF-8 does not allow are replaced, since JSON cannot hold them.
std::string file_series_text(std::span<const NamedTime> files) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const NamedTime& member : files)
    list.push_back(Json{{"name", member.file}, {"time", member.time}});
  const Json series{{"file-series-version", "1.0"}, {"files", list}};
  return series.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

const std::string final_label = "final"; // of the last mesh of a run, in the names of files

/// The number that stands behind `start` in the name of a file; -1 if none does.
int number_behind(const std::string& start, const std::string& path) {
  const std::string file = std::filesystem::path(path).filename().string();
  int number = -1;
  if (file.starts_with(start))
    std::from_chars(file.data() + start.size(), file.data() + file.size(), number);
  return number;
}

double quality_attribute(const io::Metadata& metadata, const std::string& name) {
  if (const io::MetadataGroup* group = io::find_group(metadata, "quality"))
    for (const io::Attribute& attribute : group->attributes)
      if (const double* value = std::get_if<double>(&attribute.value); value && attribute.name == name)
        return *value;
  throw FileError(fmt::format("the metadata of a mesh do not contain quality/{}", name));
}

mesh::RatioSummary ratios_of(const io::Metadata& metadata, const std::string& name) {
  const auto value = [&](const char* of) { return quality_attribute(metadata, name + of); };
  return {value("_median"), value("_mean"), value("_max"), value("_half_mean"), value("_std")};
}

/// Reads from a mesh file what the collections say about it. It reads only the ratios of the quality.
TextQuality quality_of(const io::Metadata& metadata) {
  TextQuality found;
  found.retriangulation = static_cast<int>(io::attribute_of<std::int64_t>(metadata, "retriangulation"));
  found.points = io::attribute_of<std::int64_t>(metadata, "points");
  found.triangles = io::attribute_of<std::int64_t>(metadata, "triangles");
  found.quality.alpha = ratios_of(metadata, "alpha");
  found.quality.beta = ratios_of(metadata, "beta");
  return found;
}

} // namespace

std::vector<std::string> check_output(const io::MeshFileOptions& options, const comm::Communicator& comm) {
  return MeshSeries({options, {Format::vtkhdf, Format::xdmf}, false, {}}, comm).check(0);
}

std::vector<std::string> SeriesOptions::export_paths() const {
  std::vector<std::string> paths;
  for (const Format format : formats)
    if (const FormatInfo& info = info_of(format); info.plan)
      for (const std::string& path : touched_paths(format, file.path(info.ending), names))
        paths.push_back(path);
  return paths;
}

MeshSeries::MeshSeries(SeriesOptions options, const comm::Communicator& comm)
    : options_(std::move(options)), comm_(comm) {
  options_.file.vtkhdf = options_.wants(Format::vtkhdf);
  options_.file.xdmf = options_.wants(Format::xdmf);
}

std::vector<std::string> MeshSeries::check(double expected_points) {
  std::vector<std::string> warnings;
  comm::run_agreed(comm_, [&] {
    if (comm_.is_root())
      warnings = check_files(options_, expected_points);
  });
  return warnings;
}

std::vector<std::string> MeshSeries::look(double expected_points) const {
  std::vector<std::string> warnings;
  comm::run_agreed(comm_, [&] {
    if (comm_.is_root())
      warnings = look_at_files(options_, expected_points);
  });
  return warnings;
}

std::vector<std::string> MeshSeries::go_on_after(int retriangulation) {
  std::vector<std::string> warnings;
  if (!options_.steps)
    return warnings;
  const std::string& name = options_.file.name;
  std::string list;
  comm::run_agreed(comm_, [&] {
    if (!comm_.is_root())
      return;
    std::set<int> numbers;
    for (const std::string& path : files_of_series(options_))
      if (const int number = number_behind(step_name_start(name), path);
          path.ends_with(".h5") && number >= 0 && number <= retriangulation)
        numbers.insert(number);
    for (const int number : numbers)
      list += fmt::format("{} ", number);
  });
  list = comm_.broadcast(std::move(list));
  for (const char *at = list.data(), *end = at + list.size(); at < end; ++at) {
    int number = 0;
    at = std::from_chars(at, end, number).ptr;
    const std::string stem = step_name(name, number);
    try { // what is thrown is the same on all ranks
      members_.push_back(
          {stem, quality_of(io::read_metadata(options_.file.directory + "/" + stem + ".h5", {"quality"}, comm_))});
    } catch (const FileError& error) {
      warnings.push_back(
          fmt::format("{}.h5: a step of the run before the restart cannot be read: {}; the series does not list it",
                      stem, error.what()));
    }
  }
  return warnings;
}

void MeshSeries::write_step(const SeriesMesh& mesh) {
  write(mesh, step_name(options_.file.name, mesh.retriangulation), std::to_string(mesh.retriangulation));
}

io::WrittenFiles MeshSeries::write_final(const SeriesMesh& mesh) {
  const std::size_t steps = members_.size();
  io::WrittenFiles written = write(mesh, options_.file.name, final_label);
  if (comm_.is_root() && steps > 0)
    written.paths.push_back(fmt::format("{} ({} of them)", options_.file.path("_step_*.h5"), steps));
  written.paths.insert(written.paths.end(), collections_.begin(), collections_.end());
  for (const Format format : options_.formats)
    if (const FormatInfo& info = info_of(format); info.plan) {
      const Exported made = formats::write(format, options_.file.path(info.ending), mesh.mesh, options_.names,
                                           options_.file.run_files, comm_);
      written.paths.insert(written.paths.end(), made.paths.begin(), made.paths.end());
      if (!made.checks.empty())
        cells_ = {{}, made.checks, made.summary};
      if (!made.warning.empty())
        warnings_.push_back(made.warning);
    }
  return written;
}

/// Returns the Voronoi cells if the file is to have them. If they cannot be made, the mesh is written without them, and
/// the format that needs them says why.
std::vector<io::ExtraGroup> MeshSeries::extra_groups(const mesh::DistributedMesh& mesh) const {
  if (!options_.wants(Format::voronoi) || mesh.triangle_slab.total == 0)
    return {};
  try { // what is thrown is the same on all ranks
    return {cell_arrays(mesh, options_.names.period, comm_)};
  } catch (const FileError&) {
    return {};
  }
}

io::WrittenFiles MeshSeries::write(const SeriesMesh& mesh, const std::string& name, const std::string& label) {
  io::MeshFileOptions file = options_.file;
  file.name = name;
  file.is_final = label == final_label;
  const io::WrittenFiles written = io::write_mesh_and(
      {file.is_final ? extra_groups(mesh.mesh) : std::vector<io::ExtraGroup>{}}, file, mesh.mesh, mesh.metadata, comm_);
  const bool first = !is_cleared_;
  is_cleared_ = true;
  members_.push_back(
      {name, {mesh.retriangulation, mesh.mesh.point_slab.total, mesh.mesh.triangle_slab.total, mesh.quality}});
  comm::run_agreed(comm_, [&] {
    if (comm_.is_root() && first && options_.file.overwrite)
      remove_stale(written.paths);
  });
  if (options_.wants(Format::text))
    write_text_mesh({options_.file.path(""), options_.file.name, label, options_.names.period, file.run_files},
                    mesh.mesh, comm_);
  comm::run_agreed(comm_, [&] {
    if (comm_.is_root())
      collections_ = write_collections();
  });
  return written;
}

/// Files of an older run with this name would be taken for part of this run. After a restart the steps from before it
/// belong to this run.
void MeshSeries::remove_stale(const std::vector<std::string>& written) const {
  std::set<int> kept;
  for (const Member& member : members_)
    if (member.name != options_.file.name)
      kept.insert(member.quality.retriangulation);
  const std::string& name = options_.file.name;
  for (const std::string& path : files_of_series(options_))
    if (std::find(written.begin(), written.end(), path) == written.end() &&
        !kept.contains(number_behind(step_name_start(name), path)) && !kept.contains(number_behind(name + "_", path)))
      unlink(path.c_str());
}

/// Rank 0 writes the collections of all meshes of the run again after each mesh.
std::vector<std::string> MeshSeries::write_collections() const {
  const io::MeshFileOptions& file = options_.file;
  std::vector<std::string> paths;
  if (options_.wants(Format::text)) {
    std::vector<TextQuality> lines;
    for (const Member& member : members_)
      lines.push_back(member.quality);
    io::write_text_file(file.path("") + "/" + file.name + "_tria_quality_stat_overall.txt", overall_quality_text(lines),
                        file.run_files);
    paths.push_back(file.path("") + "/" + file.name + "_*.txt");
  }
  if (options_.steps && file.xdmf) {
    std::vector<io::XdmfContent> grids;
    for (const Member& m : members_)
      grids.push_back({m.name + ".h5", io::field_group(file, "CellData"), io::field_group(file, "PointData"),
                       m.quality.points, m.quality.triangles, 0, io::id_bytes(m.quality.triangles),
                       m.quality.retriangulation});
    io::write_text_file(xdmf_collection(file), io::xdmf_series_text(grids), file.run_files);
    paths.push_back(xdmf_collection(file));
  }
  if (options_.steps && file.vtkhdf) {
    std::vector<NamedTime> views;
    for (const Member& m : members_)
      views.push_back({m.name + ".vtkhdf", m.quality.retriangulation});
    io::write_text_file(vtkhdf_collection(file), file_series_text(views), file.run_files);
    paths.push_back(vtkhdf_collection(file));
  }
  return paths;
}

} // namespace trime::formats
