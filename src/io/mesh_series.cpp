// SPDX-License-Identifier: BSD-3-Clause
#include "trime/io/mesh_series.hpp"

#include "comm/agree.hpp"
#include "io/file_series.hpp"
#include "io/output_files.hpp"
#include "io/temporary_file.hpp"
#include "io/xdmf.hpp"

#include <unistd.h>

#include <algorithm>

namespace trime::io {
namespace {

const std::string final_label = "final"; // of the last mesh of a run, in the names of files

} // namespace

std::vector<std::string> check_output(const MeshFileOptions& options, const comm::Communicator& comm) {
  return MeshSeries({options, false, false, {}}, comm).check(0);
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

void MeshSeries::write_step(const SeriesMesh& mesh) {
  write(mesh, step_name(options_.file.name, mesh.retriangulation), std::to_string(mesh.retriangulation));
}

WrittenFiles MeshSeries::write_final(const SeriesMesh& mesh) {
  const std::size_t steps = members_.size();
  WrittenFiles written = write(mesh, options_.file.name, final_label);
  if (!comm_.is_root())
    return written;
  if (steps > 0)
    written.paths.push_back(fmt::format("{} ({} of them)", options_.file.path("_step_*.h5"), steps));
  written.paths.insert(written.paths.end(), collections_.begin(), collections_.end());
  return written;
}

WrittenFiles MeshSeries::write(const SeriesMesh& mesh, const std::string& name, const std::string& label) {
  MeshFileOptions file = options_.file;
  file.name = name;
  file.is_final = label == final_label;
  const WrittenFiles written = write_mesh(file, mesh.mesh, mesh.metadata, comm_);
  const bool first = members_.empty();
  members_.push_back(
      {name, {mesh.retriangulation, mesh.mesh.point_slab.total, mesh.mesh.triangle_slab.total, mesh.quality}});
  comm::run_agreed(comm_, [&] {
    if (comm_.is_root() && first && options_.file.overwrite)
      remove_stale(written.paths);
  });
  if (options_.text)
    write_text_mesh({options_.file.path(""), options_.file.name, label, options_.period, file.run_files}, mesh.mesh,
                    comm_);
  comm::run_agreed(comm_, [&] {
    if (comm_.is_root())
      collections_ = write_collections();
  });
  return written;
}

/// What an older run of the same name has left would be taken for part of this one.
void MeshSeries::remove_stale(const std::vector<std::string>& written) const {
  for (const std::string& path : files_of_series(options_))
    if (std::find(written.begin(), written.end(), path) == written.end())
      unlink(path.c_str());
}

/// Rank 0: what speaks of all meshes of the run, anew after each of them.
std::vector<std::string> MeshSeries::write_collections() const {
  const MeshFileOptions& file = options_.file;
  std::vector<std::string> paths;
  if (options_.text) {
    std::vector<TextQuality> lines;
    for (const Member& member : members_)
      lines.push_back(member.quality);
    write_text_file(file.path("") + "/" + file.name + "_tria_quality_stat_overall.txt", overall_quality_text(lines),
                    file.run_files);
    paths.push_back(file.path("") + "/" + file.name + "_*.txt");
  }
  if (options_.steps && file.xdmf) {
    std::vector<XdmfContent> grids;
    for (const Member& m : members_)
      grids.push_back({m.name + ".h5", field_group(file, "CellData"), field_group(file, "PointData"), m.quality.points,
                       m.quality.triangles, 0, m.quality.retriangulation});
    write_text_file(xdmf_collection(file), xdmf_series_text(grids), file.run_files);
    paths.push_back(xdmf_collection(file));
  }
  if (options_.steps && file.vtkhdf) {
    std::vector<NamedTime> views;
    for (const Member& m : members_)
      views.push_back({m.name + ".vtkhdf", m.quality.retriangulation});
    write_text_file(vtkhdf_collection(file), file_series_text(views), file.run_files);
    paths.push_back(vtkhdf_collection(file));
  }
  return paths;
}

} // namespace trime::io
