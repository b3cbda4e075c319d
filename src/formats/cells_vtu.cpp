// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi cells as polygons in VTK's XML unstructured grid. A cell at which regions meet is written as one polygon
// for each of its parts, so each polygon has one region. Polygons share vertices by their numbers; in a periodic
// container, cells across the border have vertices of their own there.
#include "comm/agree.hpp"
#include "formats/cell_mesh.hpp"
#include "formats/vtu_arrays.hpp"

#include <algorithm>

namespace trime::formats {
namespace {

using dual::CellPart;
using dual::Surroundings;
using geometry::Vec2;

constexpr std::uint8_t vtk_polygon = 7;

void append_place(Vec2 place, std::string& to) {
  for (const double coordinate : {place.x, place.y, 0.0})
    append_bytes(to, coordinate);
}

/// A corner that lies a period away from its vertex.
struct Image {
  LocalIndex site;
  Vec2 place;
};

/// The cells with what the file counts: corners and parts before each site, and images of vertices.
class CellFile {
public:
  explicit CellFile(const ExchangeMesh& mesh) : cells_(std::make_shared<const CellMesh>(mesh)) {
    comm::run_agreed(mesh.comm(), [&] { count(); });
    std::array<std::int64_t, 3> totals{corners_, parts_, std::ssize(*images_)};
    for (std::size_t k = 0; k < 3; ++k)
      before_[k] = mesh.comm().exclusive_scan(totals[k]);
    mesh.comm().sum(totals);
    totals_ = totals;
  }

  FilePlan plan(const std::string& path) {
    const ExchangeMesh& mesh = cells_->mesh();
    VtuArrays data(mesh);
    std::string xml = vtu_head(vtu_numbers_by_name("region", mesh.names().regions), vertices(), totals_[1]);
    add_points(xml, data);
    add_polygons(xml, data);
    add_values(xml, data);
    return cells_->proved(vtu_file(mesh, path, xml, data));
  }

private:
  GlobalId vertices() const { return cells_->vertices().count() + totals_[2]; }

  void count() {
    const dual::Cells& cells = cells_->cells();
    const bool is_periodic = cells.period.x > 0 || cells.period.y > 0;
    Surroundings around;
    for (LocalIndex site = 0; site < cells.site_count; ++site) {
      corners_before_->push_back(corners_);
      dual::look_around(cells, site, around);
      for (const CellPart& part : dual::parts_of(around)) {
        ++parts_;
        corners_ += static_cast<std::int64_t>(part.triangles) + (part.is_round ? 0 : 3);
        if (is_periodic)
          for (const dual::CellCorner& corner : cells_->vertices().corners(around, site, part))
            if (corner.is_image)
              images_->push_back({site, cells.points[at(site)] + corner.place});
      }
    }
  }

  /// Rows with append(part, around, site, text) for each part of each cell.
  template <class Append>
  io::TextRows part_rows(const Append& append) const {
    return site_rows(cells_, [append](LocalIndex site, const Surroundings& around, std::string& to) {
      for (const CellPart& part : dual::parts_of(around))
        append(part, around, site, to);
    });
  }

  void add_points(std::string& xml, VtuArrays& data) const {
    xml += "<Points>\n" + data.describe("Float64", "Points", 3) + "</Points>\n";
    std::vector<io::TextRows> rows =
        vertex_rows(cells_, true, [](GlobalId, Vec2 place, std::string& to) { append_place(place, to); });
    rows.push_back({std::ssize(*images_), [images = images_](std::int64_t row, std::string& to) {
                      append_place((*images)[static_cast<std::size_t>(row)].place, to);
                    }});
    data.add(vertices() * 24, rows);
  }

  void add_polygons(std::string& xml, VtuArrays& data) const {
    xml += "<Cells>\n" + data.describe("Int64", "connectivity", 1);
    const auto images = images_;
    const GlobalId first_image = cells_->vertices().count() + before_[2];
    data.add(8 * totals_[0], {site_rows(cells_, [cells = cells_, images, first_image](
                                                    LocalIndex site, const Surroundings& around, std::string& to) {
               GlobalId image = first_image +
                                (std::lower_bound(images->begin(), images->end(), site,
                                                  [](const Image& at, LocalIndex wanted) { return at.site < wanted; }) -
                                 images->begin());
               for (const CellPart& part : dual::parts_of(around))
                 for (const dual::CellCorner& corner : cells->vertices().corners(around, site, part))
                   append_bytes(to, corner.is_image ? image++ : corner.vertex);
             })});
    xml += data.describe("Int64", "offsets", 1);
    data.add(8 * totals_[1], {site_rows(cells_, [before = before_[0], by_site = corners_before_](
                                                    LocalIndex site, const Surroundings& around, std::string& to) {
               std::int64_t end = before + (*by_site)[at(site)];
               for (const CellPart& part : dual::parts_of(around)) {
                 end += static_cast<std::int64_t>(part.triangles) + (part.is_round ? 0 : 3);
                 append_bytes(to, end);
               }
             })});
    xml += data.describe("UInt8", "types", 1);
    data.add(totals_[1], {part_rows([](const CellPart&, const Surroundings&, LocalIndex, std::string& to) {
               append_bytes(to, vtk_polygon);
             })});
    xml += "</Cells>\n";
  }

  void add_values(std::string& xml, VtuArrays& data) const {
    xml += "<PointData>\n</PointData>\n<CellData>\n" + data.describe("Int64", "site", 1);
    data.add(8 * totals_[1],
             {part_rows([cells = cells_](const CellPart&, const Surroundings&, LocalIndex site, std::string& to) {
               append_bytes(to, cells->cells().number_of(site));
             })});
    xml += data.describe("Float64", "site_place", 3);
    data.add(24 * totals_[1],
             {part_rows([cells = cells_](const CellPart&, const Surroundings&, LocalIndex site, std::string& to) {
               append_place(cells->cells().points[at(site)], to);
             })});
    xml += data.describe("Float64", "area", 1);
    data.add(8 * totals_[1],
             {part_rows([](const CellPart& part, const Surroundings& around, LocalIndex, std::string& to) {
               append_bytes(to, dual::moments_of(dual::corners_of(around, part)).area);
             })});
    xml += data.describe("Int32", "region", 1);
    data.add(4 * totals_[1], {part_rows([](const CellPart& part, const Surroundings&, LocalIndex, std::string& to) {
               append_bytes(to, part.region);
             })});
    xml += data.describe("Int32", "boundary", 1);
    data.add(4 * totals_[1], {part_rows([](const CellPart&, const Surroundings& around, LocalIndex, std::string& to) {
               append_bytes(to, std::int32_t{around.is_closed ? 0 : 1});
             })});
    xml += "</CellData>\n";
  }

  std::shared_ptr<const CellMesh> cells_;
  std::int64_t corners_ = 0, parts_ = 0; // of this rank
  std::shared_ptr<std::vector<std::int64_t>> corners_before_ = std::make_shared<std::vector<std::int64_t>>(); // by site
  std::shared_ptr<std::vector<Image>> images_ = std::make_shared<std::vector<Image>>();                       // by site
  std::array<std::int64_t, 3> before_{}, totals_{}; // corners, parts and images on lower ranks and on all ranks
};

} // namespace

std::vector<FilePlan> plan_voronoi(const ExchangeMesh& mesh, const std::string& path) {
  return {CellFile(mesh).plan(path)};
}

} // namespace trime::formats
