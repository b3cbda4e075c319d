// SPDX-License-Identifier: BSD-3-Clause
// GeoJSON (RFC 7946) for GDAL and QGIS: a polygon for each triangle, then a line for each labelled edge. Coordinates
// are longitude and latitude where the reference system of the mesh is known, else those of the mesh.
#include "comm/agree.hpp"
#include "formats/degrees.hpp"
#include "formats/exchange_mesh.hpp"
#include "io/point_lookup.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace trime::formats {
namespace {

using geometry::Vec2;

/// Places of the points that a rank names, in the coordinates of the file. 16 bytes a point. Collective.
class Places {
public:
  explicit Places(const ExchangeMesh& exchange) : first_(exchange.mesh().point_slab.first) {
    const mesh::DistributedMesh& mesh = exchange.mesh();
    foreign_ = mesh.foreign;
    for (std::int64_t row = 0; row < exchange.rank_lines(); ++row)
      for (const GlobalId id : exchange.line(row))
        if (id < first_ || id >= first_ + std::ssize(mesh.points))
          foreign_.push_back(id);
    std::sort(foreign_.begin(), foreign_.end());
    foreign_.erase(std::unique(foreign_.begin(), foreign_.end()), foreign_.end());
    const io::PointLookup others(mesh, foreign_, exchange.comm());
    own_.assign(mesh.points.begin(), mesh.points.end());
    for (const GlobalId id : foreign_)
      others_.push_back(others[id].position);
    if (!exchange.names().crs.empty())
      comm::run_agreed(exchange.comm(), [&] {
        for (std::vector<Vec2>* places : {&own_, &others_})
          to_degrees(*places, exchange.names().crs, "geojson");
      });
  }

  Vec2 operator[](GlobalId id) const {
    if (id >= first_ && id < first_ + std::ssize(own_))
      return own_[static_cast<std::size_t>(id - first_)];
    return others_[static_cast<std::size_t>(std::lower_bound(foreign_.begin(), foreign_.end(), id) - foreign_.begin())];
  }

private:
  GlobalId first_;
  std::vector<GlobalId> foreign_;
  std::vector<Vec2> own_, others_; // by point of the slab; by place in foreign_
};

void append_place(std::string& to, Vec2 p) {
  to += '[';
  io::append_number(to, p.x);
  to += ',';
  io::append_number(to, p.y);
  to += ']';
}

/// The text before the coordinates of a feature.
struct Head {
  const char* kind;
  GlobalId id;
  const char* label; ///< name of the property that holds `number`
  std::int64_t number;
  const std::string& name; ///< quoted
  const char* type;
};
void append_head(std::string& to, const Head& head) {
  to += fmt::format(R"({{"type":"Feature","properties":{{"kind":"{}","number":{},"{}":{},"name":{}}},)"
                    R"("geometry":{{"type":"{}","coordinates":)",
                    head.kind, head.id, head.label, head.number, head.name, head.type);
}

/// Quotes names as JSON does.
std::vector<std::string> quoted(const std::vector<std::string>& names) {
  std::vector<std::string> texts;
  for (const std::string& name : names)
    texts.push_back(nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  return texts;
}

} // namespace

std::vector<FilePlan> plan_geojson(const ExchangeMesh& mesh, const std::string& path) {
  const auto places = std::make_shared<const Places>(mesh); // shared: the rows outlive this function
  const std::vector<std::string> regions = quoted(mesh.names().regions), parts = quoted(mesh.line_names());
  const GlobalId last = mesh.lines() - 1;
  return {
      {path,
       {mesh.once("{\"type\":\"FeatureCollection\",\"features\":[\n"),
        mesh.triangle_rows([&mesh, places, regions, last](std::int64_t row, GlobalId id,
                                                          const std::array<GlobalId, 3>& corners, std::string& to) {
          const std::int64_t region = mesh.region(row);
          append_head(to, {"triangle", id, "region", region, regions[static_cast<std::size_t>(region - 1)], "Polygon"});
          to += "[[";
          for (const GlobalId corner : {corners[0], corners[1], corners[2], corners[0]}) {
            append_place(to, (*places)[corner]);
            to += ',';
          }
          to.pop_back();
          to += last < 0 && id + 1 == mesh.triangles() ? "]]}}\n" : "]]}},\n";
        }),
        mesh.line_rows([&mesh, places, parts, last](std::int64_t row, GlobalId id, const std::array<GlobalId, 2>& ends,
                                                    std::string& to) {
          const std::int64_t label = mesh.line_label(row);
          append_head(to, {"edge", id, "label", label, parts[static_cast<std::size_t>(label - 1)], "LineString"});
          to += '[';
          append_place(to, (*places)[ends[0]]);
          to += ',';
          append_place(to, (*places)[ends[1]]);
          to += id == last ? "]}}\n" : "]}},\n";
        }),
        mesh.once("]}\n")}}};
}

} // namespace trime::formats
