// SPDX-License-Identifier: BSD-3-Clause
#include "formats/text_mesh.hpp"

#include "comm/agree.hpp"
#include "formats/boundary_loops.hpp"
#include "io/point_lookup.hpp"
#include "io/temporary_file.hpp"
#include "io/text_rows.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

namespace trime::formats {
namespace {

using geometry::Vec2;

/// Endings of the files that are labelled; those of the boundary loops go on with a number.
constexpr std::array<const char*, 7> endings{"xy_id",
                                             "tria_bar_ids",
                                             "tria_bar_coords",
                                             "tria_vertex_ids",
                                             "tria_vertex_coords",
                                             "tria_quality_stat_ar",
                                             "tria_quality_stat_er"};
constexpr const char *loop_ids = "bdry_vertices_ids_CCW_", *loop_places = "bdry_vertices_coords_CCW_";
constexpr const char* overall = "tria_quality_stat_overall";

bool is_number(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return std::isdigit(static_cast<unsigned char>(c)); });
}

/// Appends `value` and a blank for each value.
template <class... T>
void append(std::string& text, T... values) {
  ((io::append_number(text, values), text += ' '), ...);
}

void append(std::string& text, Vec2 p) {
  append(text, p.x, p.y);
}

/// One mesh with all points that the rows of this rank need.
class TextMesh {
public:
  TextMesh(const TextPlace& place, const mesh::DistributedMesh& mesh, const comm::Communicator& comm)
      : place_(place), mesh_(mesh), comm_(comm), remote_(mesh, foreign_points(), comm) {}

  void write() {
    write_points();
    write_triangles();
    write_edges();
    write_loops();
    files_.complete();
  }

private:
  std::string path(const std::string& ending) const {
    return place_.folder + "/" + place_.name + "_" + place_.label + "_" + ending + ".txt";
  }

  bool is_here(GlobalId id) const {
    const GlobalId row = id - mesh_.point_slab.first;
    return row >= 0 && row < static_cast<GlobalId>(mesh_.points.size());
  }

  /// Vertices of our triangles and edges that lie on other ranks.
  std::vector<GlobalId> foreign_points() const {
    std::vector<GlobalId> ids;
    const auto add = [&](GlobalId id) {
      if (!is_here(id))
        ids.push_back(id);
    };
    std::for_each(mesh_.foreign.begin(), mesh_.foreign.end(), add);
    for (const auto& facet : mesh_.facets)
      std::for_each(facet.begin(), facet.end(), add);
    return ids;
  }

  Vec2 place_of(GlobalId id) const {
    return is_here(id) ? mesh_.points[static_cast<std::size_t>(id - mesh_.point_slab.first)] : remote_[id].position;
  }

  /// Corners of a triangle of this rank, moved by periods to be near the first one.
  std::array<Vec2, 3> corners(std::int64_t row) const {
    const auto triangle = mesh_.triangle_ids(static_cast<std::size_t>(row));
    const Vec2 first = place_of(triangle[0]);
    return {first, nearest_image(place_of(triangle[1]), first, place_.period),
            nearest_image(place_of(triangle[2]), first, place_.period)};
  }

  template <class Append>
  io::TextRows rows_of(std::size_t count, const Append& append_row) const {
    return {static_cast<std::int64_t>(count), append_row};
  }

  template <class Append>
  void write_rows(const std::string& file, std::size_t count, const Append& append_row) {
    const io::TextRows rows = rows_of(count, append_row);
    write_file(file, {&rows, 1});
  }

  /// Writes a file without a label, which the meshes of a run share: it stays even if the others are removed.
  template <class Append>
  void write_shared_rows(const std::string& name, std::size_t count, const Append& append_row) const {
    const io::TextRows rows = rows_of(count, append_row);
    io::write_text_rows(place_.folder + "/" + name + ".txt", {&rows, 1}, place_.run_files, comm_);
  }

  void write_file(const std::string& file, std::span<const io::TextRows> arrays) {
    comm::run_agreed(comm_, [&] {
      if (comm_.is_root())
        files_.add(file);
    });
    io::write_text_rows(file, arrays, place_.run_files, comm_);
  }

  void write_points() {
    const auto& points = mesh_.points;
    const auto& fixed = mesh_.fixed;
    write_rows(path("xy_id"), points.size(), [&](std::int64_t row, std::string& text) {
      append(text, points[static_cast<std::size_t>(row)]);
      text += '\n';
    });
    write_shared_rows("fixed_pt_id", points.size(), [&](std::int64_t row, std::string& text) {
      if (fixed[static_cast<std::size_t>(row)] != 0) {
        append(text, mesh_.point_slab.first + row);
        text += '\n';
      }
    });
    write_shared_rows("fixed_pt_coords", points.size(), [&](std::int64_t row, std::string& text) {
      if (fixed[static_cast<std::size_t>(row)] != 0) {
        append(text, points[static_cast<std::size_t>(row)]);
        text += '\n';
      }
    });
  }

  void write_triangles() {
    const std::size_t count = mesh_.triangles.size();
    write_rows(path("tria_vertex_ids"), count, [&](std::int64_t row, std::string& text) {
      const auto [a, b, c] = mesh_.triangle_ids(static_cast<std::size_t>(row));
      append(text, mesh_.triangle_slab.first + row, a, b, c);
      text += '\n';
    });
    write_rows(path("tria_vertex_coords"), count, [&](std::int64_t row, std::string& text) {
      append(text, mesh_.triangle_slab.first + row);
      for (const Vec2 corner : corners(row))
        append(text, corner);
      text += '\n';
    });
    const auto write_ratio = [&](const char* ending, double (*ratio)(Vec2, Vec2, Vec2)) {
      write_rows(path(ending), count, [&](std::int64_t row, std::string& text) {
        const auto [p, q, r] = corners(row);
        io::append_number(text, ratio(p, q, r));
        text += '\n';
      });
    };
    write_ratio("tria_quality_stat_ar", mesh::aspect_ratio);
    write_ratio("tria_quality_stat_er", mesh::edge_ratio);
  }

  /// Each edge once, from its lower to its higher vertex. An inner edge is directed so in exactly one of its triangles;
  /// a boundary edge that is not comes at the end.
  template <class Append>
  void write_edge_file(const std::string& file, const Append& append_edge) {
    const io::TextRows both[2] = {rows_of(mesh_.triangles.size(),
                                          [&](std::int64_t row, std::string& text) {
                                            const auto ids = mesh_.triangle_ids(static_cast<std::size_t>(row));
                                            for (std::size_t k = 0; k < 3; ++k)
                                              if (ids[k] < ids[(k + 1) % 3])
                                                append_edge(ids[k], ids[(k + 1) % 3], text);
                                          }),
                                  rows_of(mesh_.facets.size(), [&](std::int64_t row, std::string& text) {
                                    const auto& [first, second] = mesh_.facets[static_cast<std::size_t>(row)];
                                    if (second < first)
                                      append_edge(second, first, text);
                                  })};
    write_file(file, both);
  }

  void write_edges() {
    write_edge_file(path("tria_bar_ids"), [](GlobalId low, GlobalId high, std::string& text) {
      io::append_number(text, low);
      text += ' ';
      io::append_number(text, high);
      text += '\n';
    });
    write_edge_file(path("tria_bar_coords"), [&](GlobalId low, GlobalId high, std::string& text) {
      const Vec2 from = place_of(low), to = nearest_image(place_of(high), from, place_.period);
      append(text, from);
      text += '\n';
      io::append_number(text, to.x);
      text += ' ';
      io::append_number(text, to.y);
      text += "\n\n";
    });
  }

  /// The boundary edges of all ranks on rank 0.
  std::vector<LoopEdge> gather_facets() const {
    std::string bytes;
    comm::run_agreed(comm_, [&] {
      for (std::size_t k = 0; k < mesh_.facets.size(); ++k) {
        const LoopEdge edge{mesh_.facets[k][0], mesh_.facets[k][1], mesh_.facet_tags[k], place_of(mesh_.facets[k][0])};
        bytes.append(reinterpret_cast<const char*>(&edge), sizeof edge);
      }
    });
    std::vector<LoopEdge> edges;
    for (const std::string& part : comm_.gather(bytes)) {
      const std::size_t before = edges.size();
      edges.resize(before + part.size() / sizeof(LoopEdge));
      std::memcpy(static_cast<void*>(edges.data() + before), part.data(), part.size());
    }
    return edges;
  }

  void write_loops() {
    const std::vector<LoopEdge> edges = gather_facets();
    comm::run_agreed(comm_, [&] {
      const std::vector<std::vector<LoopVertex>> loops = boundary_loops(edges, place_.period);
      for (std::size_t k = 0; k < loops.size(); ++k) {
        std::string ids, places;
        for (const LoopVertex& vertex : loops[k]) {
          append(ids, vertex.id);
          append(places, vertex.place);
          ids += '\n';
          places += '\n';
        }
        write_loop_file(loop_ids + std::to_string(k), ids);
        write_loop_file(loop_places + std::to_string(k), places);
      }
      if (!loops.empty())
        io::synchronise_file_system(path(loop_ids)); // once for all of them
    });
  }

  void write_loop_file(const std::string& ending, const std::string& text) {
    files_.add(path(ending));
    io::write_text_file_of_many(path(ending), text, place_.run_files);
  }

  const TextPlace& place_;
  const mesh::DistributedMesh& mesh_;
  const comm::Communicator& comm_;
  io::PointLookup remote_;
  io::FileSet files_; ///< on rank 0
};

} // namespace

void write_text_mesh(const TextPlace& place, const mesh::DistributedMesh& mesh, const comm::Communicator& comm) {
  TextMesh(place, mesh, comm).write();
}

std::string overall_quality_text(std::span<const TextQuality> meshes) {
  std::string text;
  for (const TextQuality& m : meshes) {
    const mesh::RatioSummary &a = m.quality.alpha, &b = m.quality.beta;
    append(text, std::int64_t{m.retriangulation}, m.points, m.triangles);
    append(text, a.max, b.max, a.median, b.median, a.mean, b.mean, a.half_mean, b.half_mean, a.std, b.std);
    text += '\n';
  }
  return text;
}

bool is_text_mesh_file(const std::string& file, const std::string& name) {
  if (file == "fixed_pt_id.txt" || file == "fixed_pt_coords.txt" || file == name + "_" + overall + ".txt")
    return true;
  const std::string start = name + "_", stop = ".txt";
  if (file.size() < start.size() + stop.size() || !file.starts_with(start) || !file.ends_with(stop))
    return false;
  const std::string rest = file.substr(start.size(), file.size() - start.size() - stop.size());
  const std::size_t blank = rest.find('_');
  if (blank == std::string::npos || (rest.substr(0, blank) != "final" && !is_number(rest.substr(0, blank))))
    return false;
  const std::string ending = rest.substr(blank + 1);
  for (const std::string loop : {loop_ids, loop_places})
    if (ending.starts_with(loop))
      return is_number(std::string_view(ending).substr(loop.size()));
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

} // namespace trime::formats
