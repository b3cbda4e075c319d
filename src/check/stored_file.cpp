// SPDX-License-Identifier: BSD-3-Clause
#include "stored_file.hpp"

#include <hdf5.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <type_traits>

namespace trime_check {
namespace {

/// Closes what HDF5 has opened.
class Handle {
public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0)
      close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

Failure no_mesh(const std::string& path, const std::string& reason) {
  return {ExitCode::file, fmt::format("{}: {}", path, reason)};
}

std::vector<std::int64_t> shape_of(hid_t space) {
  std::vector<hsize_t> extents(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  if (!extents.empty())
    H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  return {extents.begin(), extents.end()};
}

std::string name_of_type(hid_t type) {
  const std::size_t bits = 8 * H5Tget_size(type);
  switch (H5Tget_class(type)) {
  case H5T_FLOAT:
    return fmt::format("float{}", bits);
  case H5T_INTEGER:
    return fmt::format("{}int{}", H5Tget_sign(type) == H5T_SGN_NONE ? "u" : "", bits);
  default:
    return "another type";
  }
}

std::string text_of_shape(const std::vector<std::int64_t>& shape) {
  std::string text;
  for (const std::int64_t extent : shape)
    text += (text.empty() ? "" : ", ") + (extent < 0 ? std::string("any") : std::to_string(extent));
  return "[" + text + "]";
}

/// @param types names of types with spaces between, such as "int32 or int64"
bool is_one_of(const std::string& type, const std::string& types) {
  return fmt::format(" {} ", types).find(fmt::format(" {} ", type)) != std::string::npos;
}

bool fits(const std::vector<std::int64_t>& shape, const std::vector<std::int64_t>& wanted) {
  bool same = shape.size() == wanted.size();
  for (std::size_t k = 0; same && k < shape.size(); ++k)
    same = wanted[k] < 0 || wanted[k] == shape[k];
  return same;
}

template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, double>)
    return H5T_NATIVE_DOUBLE;
  else
    return H5T_NATIVE_INT64;
}

std::size_t size_of(const std::vector<std::int64_t>& shape) {
  std::size_t size = 1;
  for (const std::int64_t extent : shape)
    size *= static_cast<std::size_t>(extent);
  return size;
}

/// A text as HDF5 pads it with zeros.
std::string without_padding(const char* text, std::size_t size) {
  return {text, strnlen(text, size)};
}

} // namespace

StoredFile::StoredFile(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // this program words the errors
  struct stat status {};
  if (stat(path.c_str(), &status) != 0)
    throw no_mesh(path, fmt::format("cannot be opened: {}", std::strerror(errno)));
  if (!S_ISREG(status.st_mode))
    throw no_mesh(path, "is not a regular file; expected the NAME.h5 that trime_mpi has written");
  if (H5Fis_hdf5(path.c_str()) <= 0)
    throw no_mesh(path, "is not an HDF5 file; expected the NAME.h5 that trime_mpi has written");
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0)
    throw no_mesh(path, fmt::format("HDF5 cannot open it ({} bytes): it is cut off or damaged", status.st_size));
  if (!has("/trime_mpi") || text_attribute("/trime_mpi", "format") != "trime_mpi-mesh") {
    H5Fclose(file_);
    throw no_mesh(path, "is an HDF5 file, but no mesh of trime_mpi: expected the group /trime_mpi with format = "
                        "trime_mpi-mesh");
  }
}

StoredFile::~StoredFile() {
  H5Fclose(file_);
}

bool StoredFile::has(const std::string& name) const {
  for (std::size_t end = name.find('/', 1); end != std::string::npos; end = name.find('/', end + 1))
    if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0)
      return false;
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0 && H5Oexists_by_name(file_, name.c_str(), H5P_DEFAULT) > 0;
}

template <class T>
std::vector<T> StoredFile::array(const std::string& name, const std::string& type, std::vector<std::int64_t> wanted,
                                 Tally& wrong) const {
  std::vector<T> values;
  const auto expected = [&] { return fmt::format("expected {} {}", type, text_of_shape(wanted)); };
  if (!has(name)) {
    wrong.note([&] { return fmt::format("{} is missing, {}", name, expected()); });
    return values;
  }
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (set < 0) {
    wrong.note([&] { return fmt::format("{} is not an array, {}", name, expected()); });
    return values;
  }
  const Handle space(H5Dget_space(set), H5Sclose), stored(H5Dget_type(set), H5Tclose);
  const std::vector<std::int64_t> shape = shape_of(space);
  if (!is_one_of(name_of_type(stored), type) || !fits(shape, wanted)) {
    wrong.note(
        [&] { return fmt::format("{} is {} {}, {}", name, name_of_type(stored), text_of_shape(shape), expected()); });
    return values;
  }
  values.resize(size_of(shape));
  if (H5Dread(set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    wrong.note([&] { return name + " cannot be read"; });
  return values;
}

std::optional<double> StoredFile::number(const std::string& object, const std::string& attribute) const {
  const std::vector<double> values = numbers(object, attribute);
  return values.size() == 1 ? std::optional(values[0]) : std::nullopt;
}

std::vector<double> StoredFile::numbers(const std::string& object, const std::string& attribute) const {
  if (!has(object) || H5Aexists_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT) <= 0)
    return {};
  const Handle a(H5Aopen_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(a), H5Sclose);
  std::vector<double> values(size_of(shape_of(space)));
  if (H5Aread(a, H5T_NATIVE_DOUBLE, values.data()) < 0)
    values.clear();
  return values;
}

std::optional<std::uint64_t> StoredFile::hash(const std::string& object, const std::string& attribute) const {
  if (H5Aexists_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT) <= 0)
    return std::nullopt;
  const Handle a(H5Aopen_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(a), H5Sclose);
  std::uint64_t value = 0;
  if (size_of(shape_of(space)) != 1 || H5Aread(a, H5T_NATIVE_UINT64, &value) < 0)
    return std::nullopt;
  return value;
}

std::optional<std::string> StoredFile::text_attribute(const std::string& object, const std::string& attribute) const {
  if (!has(object) || H5Aexists_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT) <= 0)
    return std::nullopt;
  const Handle a(H5Aopen_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(a), H5Tclose), space(H5Aget_space(a), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || size_of(shape_of(space)) != 1)
    return std::nullopt;
  std::vector<char> value(H5Tget_size(type) + 1);
  H5Aread(a, type, value.data());
  return without_padding(value.data(), value.size());
}

std::vector<std::string> StoredFile::names(const std::string& name) const {
  std::vector<std::string> values;
  if (!has(name))
    return values;
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
  if (set < 0 || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    return values;
  const std::size_t width = H5Tget_size(type), count = size_of(shape_of(space));
  std::vector<char> bytes(width * count + 1);
  if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    return values;
  for (std::size_t k = 0; k < count; ++k)
    values.push_back(without_padding(bytes.data() + k * width, width));
  return values;
}

std::string StoredFile::text(const std::string& name) const {
  const std::vector<std::string> texts = names(name);
  return texts.empty() ? "" : texts[0];
}

std::vector<double> StoredFile::column(const std::string& name) const {
  std::vector<double> values;
  if (!has(name))
    return values;
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(set), H5Sclose);
  values.resize(size_of(shape_of(space)));
  if (set < 0 || H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    values.clear();
  return values;
}

namespace {

/// Reads arrays of a file, and notes those that are missing or have another type or shape.
struct ArrayReader {
  const StoredFile& file;
  Tally& wrong;

  std::vector<double> reals(const std::string& name, const char* type, std::vector<std::int64_t> shape) const {
    return file.array<double>(name, type, std::move(shape), wrong);
  }
  std::vector<std::int64_t> integers(const std::string& name, const char* type, std::vector<std::int64_t> shape) const {
    return file.array<std::int64_t>(name, type, std::move(shape), wrong);
  }
};

/// The types that numbers of vertices may have; files of earlier versions and large files have the longer one.
constexpr const char* id_types = "int32 or int64";

/// Points, triangles and facets; points and triangles from the plain arrays where the file has them.
void read_elements(const ArrayReader& reader, Mesh& mesh) {
  const std::size_t columns = mesh.has_plain ? 2 : 3;
  const std::vector<double> xy = mesh.has_plain ? reader.reals("/Mesh/mesh/geometry", "float64", {-1, 2})
                                                : reader.reals("/VTKHDF/Points", "float64", {-1, 3});
  const std::vector<std::int64_t> ids = mesh.has_plain ? reader.integers("/Mesh/mesh/topology", id_types, {-1, 3})
                                                       : reader.integers("/VTKHDF/Connectivity", id_types, {-1});
  const std::vector<std::int64_t> ends = reader.integers("/Mesh/facets/topology", "int64", {-1, 2});
  for (std::size_t k = 0; k + columns <= xy.size(); k += columns)
    mesh.points.push_back({xy[k], xy[k + 1]});
  for (std::size_t k = 0; k + 3 <= ids.size(); k += 3)
    mesh.triangles.push_back({ids[k], ids[k + 1], ids[k + 2]});
  for (std::size_t k = 0; k < ends.size(); k += 2)
    mesh.facets.push_back({ends[k], ends[k + 1]});
}

std::vector<Facet> pairs_of(const std::vector<std::int64_t>& values) {
  std::vector<Facet> pairs;
  for (std::size_t k = 0; k + 1 < values.size(); k += 2)
    pairs.push_back({values[k], values[k + 1]});
  return pairs;
}

/// Edges inside: those on curves, and those between regions; and the list of all edges with labels.
void read_inner_edges(const ArrayReader& reader, Mesh& mesh) {
  if (reader.file.has("/Mesh/curves")) {
    mesh.curve_edges = pairs_of(reader.integers("/Mesh/curves/topology", "int64", {-1, 2}));
    mesh.curve_numbers = reader.integers("/Mesh/curves/values", "int32", {std::ssize(mesh.curve_edges)});
    mesh.curve_labels = reader.integers("/Mesh/curves/labels", "int32", {std::ssize(mesh.curve_edges)});
  }
  if (reader.file.has("/Mesh/interfaces")) {
    mesh.interfaces = pairs_of(reader.integers("/Mesh/interfaces/topology", "int64", {-1, 2}));
    const auto count = std::ssize(mesh.interfaces);
    mesh.interface_regions = pairs_of(reader.integers("/Mesh/interfaces/regions", "int32", {count, 2}));
    mesh.interface_pairs = reader.integers("/Mesh/interfaces/values", "int32", {count});
    mesh.interface_labels = reader.integers("/Mesh/interfaces/labels", "int32", {count});
    mesh.interface_curves = reader.integers("/Mesh/interfaces/curves", "int32", {count});
  }
  if (reader.file.has("/Mesh/splits")) {
    mesh.split_pairs = pairs_of(reader.integers("/Mesh/splits/pairs", "int64", {-1, 2}));
    mesh.split_curves = reader.integers("/Mesh/splits/curves", "int32", {std::ssize(mesh.split_pairs)});
    mesh.split_paths = reader.integers("/Mesh/splits/paths", "int32", {std::ssize(mesh.split_pairs)});
  }
  if (reader.file.has("/Mesh/lines")) {
    mesh.lines = pairs_of(reader.integers("/Mesh/lines/topology", "int64", {-1, 2}));
    mesh.line_labels = reader.integers("/Mesh/lines/labels", "int32", {std::ssize(mesh.lines)});
  }
}

/// Reads the data of facets, triangles and points.
void read_fields(const ArrayReader& reader, Mesh& mesh) {
  const auto n = std::ssize(mesh.points), m = std::ssize(mesh.triangles), b = std::ssize(mesh.facets);
  mesh.facet_tags = reader.integers("/Mesh/facets/values", "int32", {b});
  mesh.facet_parts = reader.integers("/Mesh/facets/parts", "int32", {b});
  mesh.facet_labels = reader.integers("/Mesh/facets/labels", "int32", {b});
  if (reader.file.has("/Mesh/facets/markers"))
    mesh.facet_markers = reader.integers("/Mesh/facets/markers", "int32", {b});
  mesh.asked_sizes = reader.reals("/Mesh/facets/asked_size", "float32", {b});
  read_inner_edges(reader, mesh);
  const std::string fields = mesh.has_vtk ? "/VTKHDF/" : "/Mesh/";
  mesh.alpha = reader.reals(fields + "CellData/alpha", "float32", {m});
  mesh.beta = reader.reals(fields + "CellData/beta", "float32", {m});
  mesh.region = reader.integers(fields + "CellData/region", "int32", {m});
  mesh.boundary = reader.integers(fields + "PointData/boundary", "int32", {n});
  mesh.size = reader.reals(fields + "PointData/size", "float32", {n});
  mesh.fixed = reader.integers(fields + "PointData/fixed", "uint8", {n});
  if (reader.file.has(fields + "PointData/depth"))
    mesh.depth = reader.reals(fields + "PointData/depth", "float64", {n});
  if (mesh.has_plain)
    mesh.petsc_points = reader.reals("/geometry/vertices", "float64", {n, 2});
}

void read_vtk(const ArrayReader& reader, Mesh& mesh) {
  const auto n = std::ssize(mesh.points), m = std::ssize(mesh.triangles);
  mesh.vtk_points = reader.reals("/VTKHDF/Points", "float64", {n, 3});
  mesh.connectivity = reader.integers("/VTKHDF/Connectivity", id_types, {3 * m});
  mesh.offsets = reader.integers("/VTKHDF/Offsets", id_types, {m + 1});
  mesh.types = reader.integers("/VTKHDF/Types", "uint8", {m});
  for (const char* name : {"/VTKHDF/NumberOfPoints", "/VTKHDF/NumberOfCells", "/VTKHDF/NumberOfConnectivityIds"})
    for (const std::int64_t count : reader.integers(name, "int64", {1}))
      mesh.counts.push_back(count);
}

} // namespace

bool read_mesh(const StoredFile& file, Mesh& mesh, Report& report) {
  Tally wrong;
  const ArrayReader reader{file, wrong};
  mesh.has_vtk = file.has("/VTKHDF");
  mesh.has_plain = !mesh.has_vtk || file.has("/Mesh/mesh");
  read_elements(reader, mesh);
  read_fields(reader, mesh);
  if (mesh.has_vtk)
    read_vtk(reader, mesh);
  mesh.periods = {file.number("/trime_mpi", "period_x").value_or(0), file.number("/trime_mpi", "period_y").value_or(0)};
  if (mesh.triangles.empty())
    wrong.note([] { return std::string("there are no triangles"); });
  report.none("arrays", wrong, "arrays that are missing, or have another type or shape than src/files.md says");
  return wrong.count == 0;
}

} // namespace trime_check
