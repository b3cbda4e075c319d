// SPDX-License-Identifier: BSD-3-Clause
#include "trime/facade/mesh.hpp"

#include "comm/agree.hpp"
#include "core/quoted.hpp"
#include "facade/build_shape.hpp"
#include "facade/build_size.hpp"
#include "facade/check_options.hpp"
#include "facade/implementation.hpp"
#include "facade/names.hpp"
#include "formats/cell_arrays.hpp"
#include "formats/open_boundary.hpp"
#include "formats/output_files.hpp"
#include "io/extra_arrays.hpp"
#include "record/acceptance_record.hpp"
#include "record/size_shares.hpp"
#include "trime/comm/from_mpi.hpp"
#include "trime/core/error.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"
#include "trime/dual/local_cells.hpp"
#include "trime/formats/exchange.hpp"
#include "trime/handover/local_mesh.hpp"
#include "trime/io/mesh_file.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/record/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numeric>

namespace trime {

std::int32_t number_of(const std::string& name, const std::vector<std::string>& names, const char* kind) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw ConfigError(fmt::format("the mesh has no {} '{}'{}; known: {}", kind, name, suggestion(name, names),
                                  fmt::join(names, ", ")));
  return static_cast<std::int32_t>(found - names.begin());
}

namespace {

/// Returns the number in facet_parts of a part of the boundary, or of a curve that is split.
std::int32_t facet_number(const std::string& name, const MeshNames& names) {
  const bool is_split =
      std::find(names.split_curves.begin(), names.split_curves.end(), name) != names.split_curves.end();
  return is_split ? static_cast<std::int32_t>(names.facets.size()) + number_of(name, names.curves, "curve")
                  : number_of(name, names.facets);
}

} // namespace

std::vector<Facet> LocalMesh::facets(const std::string& name) const {
  const std::int32_t part = facet_number(name, names_);
  std::vector<Facet> found;
  for (std::size_t k = 0; k < arrays_.facets.size(); ++k)
    if (arrays_.facet_parts[k] == part)
      found.push_back({arrays_.facets[k][0], arrays_.facets[k][1], arrays_.facet_triangles[k], arrays_.facet_tags[k],
                       k < at(arrays_.owned_facets)});
  return found;
}

std::vector<InnerEdge> LocalMesh::curve_edges(const std::string& name) const {
  const std::int32_t curve = number_of(name, names_.curves, "curve");
  std::vector<InnerEdge> found;
  for (std::size_t k = 0; k < arrays_.curve_edges.size(); ++k)
    if (arrays_.curve_numbers[k] == curve)
      found.push_back({arrays_.curve_edges[k][0], arrays_.curve_edges[k][1], arrays_.curve_triangles[k][0],
                       arrays_.curve_triangles[k][1], k < at(arrays_.owned_curve_edges)});
  return found;
}

std::vector<InnerEdge> LocalMesh::interfaces(const std::string& name) const {
  const std::int32_t pair = number_of(name, names_.interfaces, "interface");
  std::vector<InnerEdge> found;
  for (std::size_t k = 0; k < arrays_.interfaces.size(); ++k)
    if (arrays_.interface_pairs[k] == pair)
      found.push_back({arrays_.interfaces[k][0], arrays_.interfaces[k][1], arrays_.interface_triangles[k][0],
                       arrays_.interface_triangles[k][1], k < at(arrays_.owned_interfaces)});
  return found;
}

std::vector<std::array<GlobalId, 2>> LocalMesh::split_pairs(const std::string& name) const {
  const std::int32_t curve = number_of(name, names_.curves, "curve");
  std::vector<std::array<GlobalId, 2>> found;
  for (std::size_t k = 0; k < arrays_.split_pairs.size(); ++k)
    if (arrays_.split_curves[k] == curve)
      found.push_back(arrays_.split_pairs[k]);
  return found;
}

void LocalMesh::update_ghosts(std::span<double> values, int components) const {
  handover::update_ghosts(*communicator_, arrays_, values, components);
}
void LocalMesh::add_to_owners(std::span<double> values, int components) const {
  handover::add_to_owners(*communicator_, arrays_, values, components);
}

double LocalMesh::sum(double value) const {
  const std::vector<double> values = communicator_->all_gather(value);
  return std::accumulate(values.begin(), values.end(), 0.0);
}

namespace fs = std::filesystem;

namespace {

/// @throws ConfigError @pre a collective function of a mesh begins
void check_running() {
  if (!comm::mpi_is_running())
    throw ConfigError("MPI was finalised before the last use of a mesh: expected MPI_Finalize after it");
}

/// The largest growth of h, as in the program. Empty: the size is used as it is.
std::optional<double> growth_of(const MeshOptions& given, const Size& size) {
  if (given.gradation)
    return std::isfinite(*given.gradation) ? given.gradation : std::nullopt;
  return default_growth(
      size, std::ranges::any_of(given.regions, [](const Region& region) { return region.size.has_value(); }));
}

meshing::MeshOptions lower_options(const MeshOptions& given, const Size& size) {
  meshing::MeshOptions options;
  options.points = given.points;
  options.edge_length = given.edge_length;
  options.absolute_sizes = given.absolute_sizes;
  options.gradation = growth_of(given, size);
  options.method = given.method;
  options.min_size = given.min_size;
  options.max_size = given.max_size;
  options.features = given.features;
  options.max_sweeps = given.max_sweeps;
  options.worst_alpha = given.worst_alpha;
  options.split_ears = given.split_ears;
  options.seed = given.seed;
  return options;
}

formats::Names names_of(const record::Origin& origin) {
  formats::Names names{origin.part_names, origin.regions.names, origin.curve_names, {}, origin.period, origin.crs};
  names.curve_kinds = origin.curve_kinds;
  names.open_boundary = origin.open_boundary;
  for (std::size_t pair = 0; pair < origin.regions.pairs.size(); ++pair)
    names.interfaces.push_back(origin.regions.pair_name(pair));
  return names;
}

/// The names and markers of a mesh that is made of this shape.
record::Origin origin_of(const Shape& shape, const geometry::Domain& domain, const MeshOptions& options) {
  const geometry::Boundary& boundary = domain.boundary();
  return {boundary.part_names,
          domain.part_markers(),
          record::named(domain.regions(), shape.text()),
          {boundary.periods.x, boundary.periods.y},
          {},
          domain.curves().names,
          {},
          domain.curves().kinds,
          options.open_boundary};
}

/// The size in words, with the share of each of several sizes.
std::string described(const Size& size, const record::SizeShares& shares) {
  const std::string share_text = record::text_of(shares);
  return share_text.empty() ? text_of(size) : fmt::format("{}: {}", text_of(size), share_text);
}

/// Adds the groups that the program adds, in its order.
void add_groups(const record::SizeShares& shares, const std::vector<acceptance::Verdict>& verdicts,
                io::Metadata& metadata) {
  if (!shares.names.empty())
    metadata.groups.push_back(record::group_of(shares));
  if (!verdicts.empty())
    metadata.groups.push_back(record::accept_group(verdicts));
}

constexpr const char* how_to_replace = "set WriteOptions::overwrite to replace it, or choose another path";

void make_directory_of(const fs::path& path, const comm::Communicator& comm) {
  comm::run_agreed(comm, [&] {
    std::error_code error;
    if (comm.is_root() && path.has_parent_path())
      fs::create_directories(path.parent_path(), error);
    if (error)
      throw FileError(fmt::format("the directory {} cannot be made: {}", path.parent_path().string(), error.message()));
  });
}

/// Writes NAME.h5 with its views.
void write_mesh_file(const fs::path& file, const Mesh::Implementation& made, const WriteOptions& options) {
  const comm::Communicator& comm = *made.communicator;
  const record::Origin& origin = made.origin;
  io::MeshFileOptions target;
  target.directory = file.has_parent_path() ? file.parent_path().string() : ".";
  target.name = file.stem().string();
  target.overwrite = options.overwrite;
  target.vtkhdf = options.vtkhdf;
  target.xdmf = options.xdmf;
  target.is_final = true;
  target.part_markers = origin.part_markers;
  std::vector<std::string> paths;
  for (const char* ending : io::mesh_file_endings)
    paths.push_back(target.path(ending));
  formats::refuse_to_replace(paths, options.overwrite, how_to_replace, comm);
  for (const std::string& warning : formats::check_output(target, comm))
    fmt::print(stderr, "warning: {}\n", warning);
  std::vector<io::ExtraGroup> groups;
  if (options.voronoi)
    groups.push_back(formats::cell_arrays(made.result.mesh, origin.period, comm));
  io::write_mesh_and({groups}, target, made.result.mesh, made.metadata, comm);
}

} // namespace

Mesh::Mesh(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
Mesh::Mesh(Mesh&&) noexcept = default;
Mesh& Mesh::operator=(Mesh&&) noexcept = default;
Mesh::~Mesh() = default;

GlobalId Mesh::points() const {
  return result().mesh.point_slab.total;
}
GlobalId Mesh::triangles() const {
  return result().mesh.triangle_slab.total;
}
bool Mesh::certified() const {
  return io::attribute_of<std::int64_t>(implementation_->metadata, "complete") != 0;
}
const mesh::Checks& Mesh::checks() const {
  return result().checks;
}
const mesh::QualitySummary& Mesh::quality() const {
  return result().quality;
}
std::vector<Verdict> Mesh::verdicts() const {
  return record::verdicts_of(implementation_->metadata);
}
std::vector<SizeShare> Mesh::size_shares() const {
  return record::shares_of(implementation_->metadata);
}
std::uint64_t Mesh::hash() const {
  return result().mesh.hash;
}
int Mesh::sweeps() const {
  return result().history.empty() ? 0 : result().history.back().sweep;
}
const std::vector<std::string>& Mesh::facet_names() const {
  return implementation_->origin.part_names;
}
MeshNames Mesh::names() const {
  const formats::Names names = names_of(implementation_->origin);
  MeshNames made{names.parts, names.regions, names.curves, names.interfaces};
  for (std::size_t k = 0; k < names.curve_kinds.size(); ++k)
    if (names.curve_kinds[k].split)
      made.split_curves.push_back(names.curves[k]);
  return made;
}
const meshing::MeshResult& Mesh::result() const {
  return implementation_->result;
}
const comm::Communicator& Mesh::communicator() const {
  return *implementation_->communicator;
}

std::vector<std::array<GlobalId, 2>> Mesh::facets(const std::string& name) const {
  const std::int32_t part = facet_number(name, names());
  const mesh::DistributedMesh& mesh = result().mesh;
  std::vector<std::array<GlobalId, 2>> found;
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    if (mesh.facet_parts[k] == part)
      found.push_back(mesh.facets[k]);
  return found;
}

geometry::Vec2 Mesh::periods() const {
  return implementation_->origin.period;
}

LocalMesh Mesh::local(handover::Overlap overlap) const {
  check_running();
  return {handover::make_local_mesh(communicator(), result().mesh, overlap), names(), implementation_->communicator};
}

LocalCells Mesh::cells() const {
  LocalMesh mesh = local();
  dual::LocalCells cells = dual::make_local_cells(communicator(), mesh.arrays(), periods());
  return {std::move(mesh), std::move(cells)};
}

void Mesh::write(const std::string& path, const WriteOptions& options) const {
  check_running();
  const comm::Communicator& comm = communicator();
  const record::Origin& origin = implementation_->origin;
  const fs::path file(path);
  if (file.extension() == ".h5") {
    write_mesh_file(file, *implementation_, options);
    return;
  }
  const auto format = formats::format_of_path(path);
  if (!format)
    throw ConfigError(fmt::format("{}: expected a path that ends in .h5, or in the ending of another format, such as "
                                  ".msh, .vtu or .geojson",
                                  path));
  formats::Names names = names_of(origin);
  names.cells = options.cells;
  formats::refuse_to_replace(formats::touched_paths(*format, path, names), options.overwrite, how_to_replace, comm);
  make_directory_of(file, comm);
  const formats::Exported made = formats::write(*format, path, result().mesh, names, nullptr, comm);
  if (!made.warning.empty() && comm.is_root())
    fmt::print(stderr, "warning: {}: {}\n", path, made.warning);
  for (const mesh::Check& check : made.checks)
    if (!check.passed && comm.is_root())
      fmt::print(stderr, "warning: {}: check {} FAILED: expected {:.15g}, found {:.15g} ({})\n", path, check.name,
                 check.expected, check.found, check.meaning);
}

Mesh make_mesh(MPI_Comm handle, const Shape& shape, const Size& size, const MeshOptions& options) {
  const auto comm = std::make_shared<const comm::Communicator>(comm::duplicate_of(handle));
  check_options(shape, size, options, *comm);
  Log quiet(LogLevel::warning, comm->is_root() && options.log == nullptr, stderr);
  Log& log = options.log != nullptr ? *options.log : quiet;
  const geometry::Domain domain = build_domain(shape, options, *comm, log);
  auto made = std::make_unique<Mesh::Implementation>();
  made->communicator = comm;
  made->origin = origin_of(shape, domain, options);
  const std::vector<bool> open = formats::open_parts(names_of(made->origin)); // refuses unknown names, on all ranks
  const meshing::MeshOptions lower = lower_options(options, size);
  const BuiltSize built = build_size(size, domain, options.regions, lower, *comm);
  TimerTable timers;
  meshing::Mesher mesher(*comm, domain, *built.field, lower, log, timers);
  if (options.start)
    mesher.start_from({options.start->result().mesh.points, options.start->periods()});
  made->result = mesher.run();
  const std::vector<acceptance::Verdict> verdicts =
      record::judge_mesh({models_of(options.accept), domain.frame().periods(), open}, made->result, *comm);
  record::print_verdicts(verdicts, options.split_ears, log);
  const record::SizeShares shares = record::shares_of_sizes(built.combined(), made->result.mesh, *comm);
  made->metadata = record::describe(made->result, made->origin, described(size, shares), *comm);
  add_groups(shares, verdicts, made->metadata);
  return Mesh(std::move(made));
}

Mesh make_mesh(MPI_Comm comm, const Shape& shape, const MeshOptions& options) {
  return make_mesh(comm, shape, sizes::uniform(), options);
}

} // namespace trime
