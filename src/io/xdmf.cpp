// SPDX-License-Identifier: BSD-3-Clause
#include "io/xdmf.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace trime::io {
namespace {

/// Characters that mean something in XML.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text)
    switch (c) {
    case '&':
      result += "&amp;";
      break;
    case '<':
      result += "&lt;";
      break;
    case '>':
      result += "&gt;";
      break;
    default:
      result += c;
    }
  return result;
}

struct Field {
  const char* name;
  const char* center; ///< "Node" or "Cell"
  const char* number_type;
  int precision; ///< bytes
};

std::string attribute(const XdmfContent& content, const Field& field) {
  const bool on_cells = field.center[0] == 'C';
  return fmt::format(" <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"{}\">\n"
                     "  <DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:{}/{}"
                     "</DataItem></Attribute>\n",
                     field.name, field.center, on_cells ? content.triangles : content.points, field.number_type,
                     field.precision, escaped(content.file), on_cells ? content.cell_data : content.point_data,
                     field.name);
}

constexpr const char* header = "<?xml version=\"1.0\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
                               "<Xdmf Version=\"3.0\"><Domain>";

struct Cells {
  const char* type;
  int corners;
  std::int64_t count;
  const char* group;
  int bytes_per_id;
};

/// Corners of cells of a type, and the points.
std::string topology(const XdmfContent& content, const Cells& cells) {
  return fmt::format(
      " <Topology TopologyType=\"{4}\" NumberOfElements=\"{1}\" NodesPerElement=\"{3}\">\n"
      "  <DataItem Dimensions=\"{1} {3}\" NumberType=\"Int\" Precision=\"{6}\" Format=\"HDF\">{2}:/Mesh/{5}/topology"
      "</DataItem></Topology>\n"
      " <Geometry GeometryType=\"XY\">\n"
      "  <DataItem Dimensions=\"{0} 2\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">{2}:/Mesh/mesh/geometry"
      "</DataItem></Geometry>\n",
      content.points, cells.count, escaped(content.file), cells.corners, cells.type, cells.group, cells.bytes_per_id);
}

/// A grid of one file; `extra` follows its start.
std::string grid(const XdmfContent& content, const std::string& extra) {
  std::string text = fmt::format("<Grid Name=\"mesh\" GridType=\"Uniform\">\n{}{}", extra,
                                 topology(content, {"Triangle", 3, content.triangles, "mesh", content.bytes_per_id}));
  std::array fields{Field{"alpha", "Cell", "Float", 4}, Field{"beta", "Cell", "Float", 4},
                    Field{"region", "Cell", "Int", 4},  Field{"boundary", "Node", "Int", 4},
                    Field{"size", "Node", "Float", 4},  Field{"fixed", "Node", "UChar", 1}};
  if (content.has_regions) // dolfinx reads the first one as tags of the cells
    std::swap(fields[0], fields[2]);
  for (const Field& field : fields)
    text += attribute(content, field);
  if (content.has_depth)
    text += attribute(content, {"depth", "Node", "Float", 8});
  return text + "</Grid>";
}

} // namespace

/// One Domain with one Grid, sizes equal to the HDF5 shapes, no Time and no Information: meshio and dolfinx refuse
/// more.
std::string xdmf_text(const XdmfContent& content) {
  return header + grid(content, "") + "</Domain></Xdmf>\n";
}

/// Returns the text of a separate file for the labelled edges, since meshio refuses a second grid. It is NAME.xmf,
/// since dolfinx looks for arrays in the file of the same name with the ending .h5. dolfinx takes the first attribute
/// of the grid.
std::string xdmf_facets_text(const XdmfContent& content) {
  const char* group = content.has_inner_lines ? "lines" : "facets";
  return fmt::format("{}<Grid Name=\"facets\" GridType=\"Uniform\">\n{}"
                     " <Attribute Name=\"labels\" AttributeType=\"Scalar\" Center=\"Cell\">\n"
                     "  <DataItem Dimensions=\"{}\" NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">"
                     "{}:/Mesh/{}/labels</DataItem></Attribute>\n</Grid></Domain></Xdmf>\n",
                     header, topology(content, {"Polyline", 2, content.lines, group, 8}), content.lines,
                     escaped(content.file), group);
}

std::string xdmf_series_text(std::span<const XdmfContent> meshes) {
  std::string text =
      std::string(header) + "<Grid Name=\"series\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const XdmfContent& mesh : meshes)
    text += grid(mesh, fmt::format(" <Time Value=\"{}\"/>\n", mesh.time)) + "\n";
  return text + "</Grid></Domain></Xdmf>\n";
}

} // namespace trime::io
