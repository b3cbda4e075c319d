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

/// A cell that the boundary or regions divide, and what is counted before it on this rank.
struct DividedCell {
  LocalIndex site;
  std::int64_t parts_before; ///< of cells that are divided
  std::vector<std::int32_t> regions;
};

/// The cells with what the file counts: cells that are divided, and images of vertices. All other cells have one part,
/// whose corners are the circumcentres of their triangles, so most arrays need no geometry.
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
  using DividedCells = std::vector<DividedCell>; // by site

  GlobalId vertices() const { return cells_->vertices().count() + totals_[2]; }
  bool is_periodic() const { return cells_->cells().period.x > 0 || cells_->cells().period.y > 0; }

  void count() {
    const dual::Cells& cells = cells_->cells();
    std::int64_t parts = 0; // of cells that are divided
    Surroundings around;
    for (LocalIndex site = 0; site < cells.site_count; ++site) {
      const bool is_inside = cells.region_inside(site) != 0;
      if (is_inside && !is_periodic())
        continue;
      dual::look_around(cells, site, around);
      if (!is_inside) {
        DividedCell& cell = divided_->emplace_back(DividedCell{site, parts, {}});
        for (const CellPart& part : dual::parts_of(around))
          cell.regions.push_back(part.region);
        parts += std::ssize(cell.regions);
      }
      if (is_periodic())
        add_images(site, around);
    }
    parts_ = cells.site_count - std::ssize(*divided_) + parts;
    corners_ = cells.fan_first.back() + 3 * parts;
  }

  void add_images(LocalIndex site, const Surroundings& around) {
    for (const CellPart& part : dual::parts_of(around))
      for (const dual::CellCorner& corner : cells_->vertices().corners(around, site, part))
        if (corner.is_image)
          images_->push_back({site, cells_->cells().points[at(site)] + corner.place});
  }

  static DividedCells::const_iterator first_from(const DividedCells& divided, LocalIndex site) {
    return std::lower_bound(divided.begin(), divided.end(), site,
                            [](const DividedCell& cell, LocalIndex wanted) { return cell.site < wanted; });
  }

  /// Rows with append(region, site, text) for each part of each cell.
  template <class Append>
  io::TextRows part_rows(const Append& append) const {
    return {cells_->cells().site_count,
            [cells = cells_, divided = divided_, append](std::int64_t row, std::string& to) {
              const auto site = static_cast<LocalIndex>(row);
              if (const std::int32_t region = cells->cells().region_inside(site); region != 0) {
                append(region, site, to);
                return;
              }
              for (const std::int32_t region : first_from(*divided, site)->regions)
                append(region, site, to);
            }};
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

  io::TextRows corner_rows() const {
    const auto images = images_;
    const GlobalId first_image = cells_->vertices().count() + before_[2];
    return site_rows(
        cells_, [cells = cells_, images, first_image](LocalIndex site, const Surroundings& around, std::string& to) {
          GlobalId image =
              first_image + (std::lower_bound(images->begin(), images->end(), site,
                                              [](const Image& at, LocalIndex wanted) { return at.site < wanted; }) -
                             images->begin());
          for (const CellPart& part : dual::parts_of(around))
            for (const dual::CellCorner& corner : cells->vertices().corners(around, site, part))
              append_bytes(to, corner.is_image ? image++ : corner.vertex);
        });
  }

  /// Returns the same rows for a mesh in which no vertex has an image.
  io::TextRows plain_corner_rows() const {
    return {cells_->cells().site_count, [cells = cells_](std::int64_t row, std::string& to) {
              const dual::Cells& all = cells->cells();
              const auto site = static_cast<LocalIndex>(row);
              if (all.region_inside(site) != 0) {
                for (const LocalIndex triangle : all.fan(site).triangles)
                  append_bytes(to, all.triangles[at(triangle)].number);
                return;
              }
              Surroundings around;
              dual::look_around(all, site, around);
              for (const CellPart& part : dual::parts_of(around))
                for (const dual::CellCorner& corner : cells->vertices().corners(around, site, part))
                  append_bytes(to, corner.vertex);
            }};
  }

  /// The number of corners of all cells up to each part. A part of a divided cell has three more than triangles.
  io::TextRows end_rows() const {
    return {cells_->cells().site_count,
            [before = before_[0], cells = cells_, divided = divided_](std::int64_t row, std::string& to) {
              const dual::Cells& all = cells->cells();
              const auto site = static_cast<LocalIndex>(row);
              const auto next = first_from(*divided, site);
              const std::int64_t parts = next != divided->end() ? next->parts_before
                                         : divided->empty()
                                             ? 0
                                             : divided->back().parts_before + std::ssize(divided->back().regions);
              std::int64_t end = before + all.fan_first[at(site)] + 3 * parts;
              if (next == divided->end() || next->site != site) {
                append_bytes(to, end + std::ssize(all.fan(site).triangles));
                return;
              }
              Surroundings around;
              dual::look_around(all, site, around);
              for (const CellPart& part : dual::parts_of(around)) {
                end += static_cast<std::int64_t>(part.triangles) + 3;
                append_bytes(to, end);
              }
            }};
  }

  void add_polygons(std::string& xml, VtuArrays& data) const {
    xml += "<Cells>\n" + data.describe("Int64", "connectivity", 1);
    data.add(8 * totals_[0], {is_periodic() ? corner_rows() : plain_corner_rows()});
    xml += data.describe("Int64", "offsets", 1);
    data.add(8 * totals_[1], {end_rows()});
    xml += data.describe("UInt8", "types", 1);
    data.add(totals_[1], {part_rows([](std::int32_t, LocalIndex, std::string& to) { append_bytes(to, vtk_polygon); })});
    xml += "</Cells>\n";
  }

  io::TextRows area_rows() const {
    return {cells_->cells().site_count, [cells = cells_](std::int64_t row, std::string& to) {
              const dual::Cells& all = cells->cells();
              const auto site = static_cast<LocalIndex>(row);
              if (all.region_inside(site) != 0) {
                append_bytes(to, dual::moments_inside(all, site).area);
                return;
              }
              Surroundings around;
              dual::look_around(all, site, around);
              for (const CellPart& part : dual::parts_of(around))
                append_bytes(to, dual::moments_of(around, part).area);
            }};
  }

  void add_values(std::string& xml, VtuArrays& data) const {
    xml += "<PointData>\n</PointData>\n<CellData>\n" + data.describe("Int64", "site", 1);
    data.add(8 * totals_[1], {part_rows([cells = cells_](std::int32_t, LocalIndex site, std::string& to) {
               append_bytes(to, cells->cells().number_of(site));
             })});
    xml += data.describe("Float64", "site_place", 3);
    data.add(24 * totals_[1], {part_rows([cells = cells_](std::int32_t, LocalIndex site, std::string& to) {
               append_place(cells->cells().points[at(site)], to);
             })});
    xml += data.describe("Float64", "area", 1);
    data.add(8 * totals_[1], {area_rows()});
    xml += data.describe("Int32", "region", 1);
    data.add(4 * totals_[1],
             {part_rows([](std::int32_t region, LocalIndex, std::string& to) { append_bytes(to, region); })});
    xml += data.describe("Int32", "boundary", 1);
    data.add(4 * totals_[1], {part_rows([cells = cells_](std::int32_t, LocalIndex site, std::string& to) {
               append_bytes(to, std::int32_t{cells->cells().closed[at(site)] ? 0 : 1});
             })});
    xml += "</CellData>\n";
  }

  std::shared_ptr<const CellMesh> cells_;
  std::int64_t corners_ = 0, parts_ = 0; // of this rank
  std::shared_ptr<DividedCells> divided_ = std::make_shared<DividedCells>();
  std::shared_ptr<std::vector<Image>> images_ = std::make_shared<std::vector<Image>>(); // by site
  std::array<std::int64_t, 3> before_{}, totals_{}; // corners, parts and images on lower ranks and on all ranks
};

} // namespace

std::vector<FilePlan> plan_voronoi(const ExchangeMesh& mesh, const std::string& path) {
  return {CellFile(mesh).plan(path)};
}

} // namespace trime::formats
