// SPDX-License-Identifier: BSD-3-Clause
#include "app/refine.hpp"

#include "app/machine.hpp"
#include "app/refined_metadata.hpp"
#include "app/stored_shape.hpp"
#include "comm/agree.hpp"
#include "core/quoted.hpp"
#include "formats/cell_arrays.hpp"
#include "formats/output_files.hpp"
#include "io/extra_arrays.hpp"
#include "record/groups.hpp"
#include "trime/core/timer.hpp"
#include "trime/refinement/refine.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>

namespace trime::app {
namespace {

using io::Metadata;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Directory and NAME of a mesh file. @throws ConfigError on all ranks unless the path ends with .h5
io::MeshFileOptions output_of(const std::string& path, bool overwrite) {
  const std::filesystem::path file(path);
  if (file.extension() != ".h5" || file.stem().empty())
    throw ConfigError(fmt::format("'trime_mpi refine' writes a mesh file: expected a name that ends with .h5, found "
                                  "'{}'; 'trime_mpi convert' writes other formats",
                                  shown(path)));
  io::MeshFileOptions options;
  options.directory = file.has_parent_path() ? file.parent_path().string() : ".";
  options.name = file.stem().string();
  options.overwrite = overwrite;
  options.is_final = true;
  return options;
}

/// The mesh is read before it is replaced, but a failure in between must not cost the only copy.
void refuse_same_file(const std::string& from, const std::string& to, const comm::Communicator& comm) {
  comm::run_agreed(comm, [&] {
    std::error_code error;
    if (comm.is_root() && std::filesystem::equivalent(from, to, error))
      throw ConfigError(fmt::format("'trime_mpi refine' reads and would replace the same file {}; give the refined "
                                    "mesh another name",
                                    from));
  });
}

/// Reads the mesh. @throws ConfigError on all ranks if curves of it are split
mesh::DistributedMesh unsplit_mesh(const std::string& path, const Metadata& metadata, const comm::Communicator& comm) {
  mesh::DistributedMesh mesh = io::read_mesh(path, metadata, comm);
  if (mesh.split_slab.total > 0)
    throw ConfigError(fmt::format("{} has curves with split = true: {} pairs of its points lie at the same places, and "
                                  "'trime_mpi refine' cannot keep them together; refine a mesh of the same config "
                                  "without split, or make a mesh with more points",
                                  path, mesh.split_slab.total));
  return mesh;
}

/// Returns the largest power of two that divides a coordinate; infinity for 0.
double step_of(double coordinate) {
  if (coordinate == 0)
    return infinity;
  int exponent = 0;
  const auto digits = static_cast<std::uint64_t>(std::ldexp(std::fabs(std::frexp(coordinate, &exponent)), 53));
  return std::ldexp(1.0, exponent - 53 + std::countr_zero(digits));
}

/// @brief Returns a container of all points, for a mesh whose container is not known: the box around them, in a
/// periodic container one with its periods. It is made larger until its lattice is as coarse as that of the points.
/// Collective.
geometry::Frame frame_around(const mesh::DistributedMesh& mesh, const Metadata& metadata,
                             const comm::Communicator& comm) {
  constexpr double coarser = 64; // at most: of few points, all may lie on a lattice that is too coarse for new ones
  std::array<double, 5> least{infinity, infinity, infinity, infinity, infinity};
  for (const geometry::Vec2 p : mesh.points)
    least = {std::min(least[0], p.x), std::min(least[1], p.y), std::min(least[2], -p.x), std::min(least[3], -p.y),
             std::min({least[4], step_of(p.x), step_of(p.y)})};
  comm.min(least);
  geometry::Box box{{least[0], least[1]}, {-least[2], -least[3]}};
  const double period_x = io::attribute_of<double>(metadata, "period_x");
  const double period_y = io::attribute_of<double>(metadata, "period_y");
  const double step = std::min(least[4], coarser * geometry::Lattice(box).step());
  const double side = 0.75 * 0x1p44 * step; // of a container with such a lattice
  const auto grow = [side](double low, double& high, double period) {
    high = period > 0 ? low + period : std::fmax(high, low + side);
  };
  grow(box.min.x, box.max.x, period_x);
  grow(box.min.y, box.max.y, period_y);
  return geometry::Frame(box, period_x > 0, period_y > 0);
}

/// Sets the limits that the mesh had to keep.
void take_promises(const Metadata& metadata, refinement::Surroundings& surroundings) {
  for (const mesh::Check& check : record::checks_of(metadata))
    if (check.name == "worst_alpha")
      surroundings.worst_alpha = check.expected;
    else if (check.name == "longest_edge")
      surroundings.limits_edges = true;
}

void warn(const StoredShape& shape, const refinement::BoundaryMiddles& middles, const std::string& from, Log& log) {
  const std::int64_t all = middles.on_curve + middles.near_curve + middles.straight + middles.refused;
  if (all == 0)
    return;
  if (!shape.input)
    log.warning("the {} new boundary points lie in the middles of the boundary edges of {}, not on the curves of the "
                "shape: {}",
                all, from, shape.reason);
  else if (middles.straight > 0)
    log.warning("{} of {} new boundary points lie in the middles of boundary edges, because no curve of the "
                "shape leads from one end of these edges to the other",
                middles.straight, all);
  if (middles.refused > 0)
    log.warning("{} of {} new boundary points lie in the middles of boundary edges, because on the curve of the shape "
                "they would make bad triangles or crossing edges",
                middles.refused, all);
}

/// The rules need names of the boundary and more from the run that made the mesh, so nothing measures them here.
void warn_of_rules(const Metadata& metadata, Log& log) {
  if (io::find_group(metadata, "accept"))
    log.warning("the mesh was measured by the rules of 'accept' in [output], but the refined mesh is not: its file has "
                "neither these rules nor their checks");
}

/// Returns the Voronoi cells if the config asks for them and if they are right; if they are not, a warning says so.
std::vector<io::ExtraGroup> cells_of(const mesh::DistributedMesh& mesh, const Metadata& metadata,
                                     const comm::Communicator& comm, Log& log) {
  const geometry::Vec2 period{io::attribute_of<double>(metadata, "period_x"),
                              io::attribute_of<double>(metadata, "period_y")};
  const std::size_t regions = io::column_of<std::string>(metadata, "tags", "region_name").size();
  if (mesh::all_passed(formats::cell_checks(mesh, period, regions, comm)))
    return {formats::cell_arrays(mesh, period, comm)};
  log.warning(
      "the refined mesh has triangles whose circumcentres lie behind the boundary or whose circles hold points, "
      "so its file gets no Voronoi cells; make a mesh with more points instead");
  return {};
}

} // namespace

ExitCode refine(const CommandLine& line, io::RunFiles* files, const comm::Communicator& comm, Log& log) {
  const double start = wall_seconds();
  const std::string &from = line.files[0], &to = line.files[1];
  io::MeshFileOptions options = output_of(to, line.overwrite);
  refuse_same_file(from, to, comm);
  std::vector<std::string> paths;
  for (const char* ending : io::mesh_file_endings)
    paths.push_back(options.path(ending));
  formats::refuse_to_replace(paths, line.overwrite, "add --overwrite to replace it", comm);
  const Placement placement = place_threads(0, 0, comm);
  use_threads(placement, placement.threads);

  const Metadata metadata = io::read_metadata(from, groups_to_refine(), comm);
  refinement::Refined refined;
  const StoredShape shape = stored_shape(metadata, from, comm);
  {
    const mesh::DistributedMesh mesh = unsplit_mesh(from, metadata, comm);
    refinement::Surroundings surroundings{
        shape.input ? shape.input->domain().frame() : frame_around(mesh, metadata, comm), shape.curves()};
    take_promises(metadata, surroundings);
    refined = refinement::refine(comm, mesh, surroundings);
  }
  warn(shape, refined.middles, from, log);
  warn_of_rules(metadata, log);
  options.vtkhdf = shape.vtkhdf;
  options.xdmf = shape.xdmf;
  options.run_files = files;
  options.part_markers = io::column_of<std::int32_t>(metadata, "tags", "part_marker");
  const Metadata described = refined_metadata(metadata, refined, line, wall_seconds() - start, comm);
  const std::vector<io::ExtraGroup> groups =
      shape.cells ? cells_of(refined.mesh, metadata, comm, log) : std::vector<io::ExtraGroup>{};
  const io::WrittenFiles written = io::write_mesh_and({groups}, options, refined.mesh, described, comm);
  log.info("{}: {} points, {} triangles, {} boundary edges; mesh hash {:016x}", to, refined.mesh.point_slab.total,
           refined.mesh.triangle_slab.total, refined.mesh.facet_slab.total, refined.mesh.hash);
  const bool is_complete = comm.broadcast(std::string{says_complete(described) ? '1' : '0'}) == "1";
  if (!is_complete)
    log.warning("{} holds a mesh that is NOT complete, see 'trime_mpi info {}'", to, to);
  return is_complete ? ExitCode::done : ExitCode::incomplete;
}

} // namespace trime::app
