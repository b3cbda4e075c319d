// SPDX-License-Identifier: BSD-3-Clause
// Selafin of TELEMAC (user's manual, appendix "Description of the Selafin format"): Fortran records of big-endian
// numbers, with the height of the ground as variable BOTTOM; and the file of boundary conditions, with one line for
// each point on the boundary. A point is open if an edge at it is open: there the depth is prescribed and the velocity
// free. All others are walls. Users replace the codes where their model needs others.
#include "comm/outbox.hpp"
#include "formats/netcdf_header.hpp"
#include "formats/node_strings.hpp"
#include "formats/open_boundary.hpp"
#include "trime/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <memory>

namespace trime::formats {
namespace {

/// A point on the boundary with its number along the rings, from 1.
struct BoundaryNumber {
  GlobalId point;
  std::int64_t number;
};

std::int32_t int32_of(std::int64_t number) {
  return static_cast<std::int32_t>(number);
}

/// The length in bytes, which stands before and behind each record.
std::string mark(std::int64_t bytes) {
  std::string text;
  append_big(text, int32_of(bytes));
  return text;
}

std::string record(const std::string& bytes) {
  return mark(std::ssize(bytes)) + bytes + mark(std::ssize(bytes));
}

std::string number_record(std::initializer_list<std::int64_t> numbers) {
  std::string bytes;
  for (const std::int64_t number : numbers)
    append_big(bytes, int32_of(number));
  return record(bytes);
}

std::string padded(std::string text, std::size_t length) {
  text.resize(length, ' ');
  return text;
}

void check_records(const ExchangeMesh& mesh) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  const std::int64_t longest = std::max(3 * 4 * mesh.triangles(), 8 * mesh.points());
  if (longest > most)
    throw ConfigError(fmt::format("a record of the format 'slf' has at most {} bytes, which suffices for about {} "
                                  "triangles, found {}; use another format",
                                  most, most / 12, mesh.triangles()));
}

/// Returns the number of each point of this rank along the boundary; 0 inside. Rank 0 sends them to the owners.
/// Collective.
std::vector<std::int32_t> boundary_numbers(const ExchangeMesh& mesh, const std::vector<BoundaryRing>& rings) {
  const comm::Communicator& comm = mesh.comm();
  std::vector<GlobalId> firsts; // on rank 0
  for (const std::string& first : comm.gather(std::to_string(mesh.mesh().point_slab.first)))
    firsts.push_back(std::stoll(first));
  comm::Outbox<BoundaryNumber> away;
  std::int64_t number = 0;
  for (const BoundaryRing& ring : rings)
    for (const GlobalId point : ring.points)
      // Ranks without points start where the next one does.
      away[static_cast<int>(std::ranges::upper_bound(firsts, point) - firsts.begin()) - 1].push_back({point, ++number});
  std::vector<std::int32_t> numbers(mesh.mesh().points.size(), 0);
  for (const comm::Message& message : comm::send(comm, away))
    for (const BoundaryNumber& given : comm::from_bytes<BoundaryNumber>(message.data))
      numbers[static_cast<std::size_t>(given.point - mesh.mesh().point_slab.first)] = int32_of(given.number);
  return numbers;
}

/// The file of boundary conditions: codes of depth, velocities and tracer, prescribed values, the point, and its
/// number.
std::string conditions(const std::vector<BoundaryRing>& rings, const std::vector<bool>& is_open) {
  constexpr const char* wall = "2 2 2 0.0 0.0 0.0 0.0 2 0.0 0.0 0.0";
  constexpr const char* open = "5 4 4 0.0 0.0 0.0 0.0 4 0.0 0.0 0.0";
  std::string text;
  std::int64_t number = 0;
  for (const BoundaryRing& ring : rings)
    for (std::size_t k = 0; k < ring.points.size(); ++k) {
      const auto part_is_open = [&](std::int64_t label) {
        return static_cast<std::size_t>(label - 1) < is_open.size() && is_open[static_cast<std::size_t>(label - 1)];
      };
      const std::int64_t before = ring.labels[k == 0 ? ring.labels.size() - 1 : k - 1];
      text += fmt::format("{} {} {}\n", part_is_open(ring.labels[k]) || part_is_open(before) ? open : wall,
                          ring.points[k] + 1, ++number);
    }
  return text;
}

std::string header(const ExchangeMesh& mesh) {
  const std::vector<std::string>& regions = mesh.names().regions;
  return record(padded(regions.size() == 1 ? regions[0] : "mesh", 72) + "SERAFIND") + number_record({1, 0}) +
         record(padded("BOTTOM", 16) + padded("M", 16)) + number_record({1, 0, 0, 0, 0, 0, 0, 0, 0, 0}) +
         number_record({mesh.triangles(), mesh.points(), 3, 1});
}

/// Rows of a record with one number per point. @param value of a row of this rank
template <class Value>
void add_record(const ExchangeMesh& mesh, const Value& value, std::vector<io::TextRows>& rows) {
  const auto bytes = static_cast<std::int64_t>(sizeof(value(std::size_t{}))) * mesh.points();
  rows.push_back(mesh.once(mark(bytes)));
  rows.push_back(mesh.point_rows([value](std::int64_t row, GlobalId, geometry::Vec2, std::string& to) {
    append_big(to, value(static_cast<std::size_t>(row)));
  }));
  rows.push_back(mesh.once(mark(bytes)));
}

} // namespace

std::vector<FilePlan> plan_telemac(const ExchangeMesh& mesh, const std::string& path) {
  check_records(mesh); // all ranks find the same
  const std::vector<BoundaryRing> rings = boundary_rings(mesh);
  const auto numbers = std::make_shared<const std::vector<std::int32_t>>(boundary_numbers(mesh, rings));
  const mesh::DistributedMesh& data = mesh.mesh();
  std::vector<io::TextRows> rows{
      mesh.once(header(mesh) + mark(12 * mesh.triangles())),
      mesh.triangle_rows([](std::int64_t, GlobalId, const std::array<GlobalId, 3>& corners, std::string& to) {
        for (const GlobalId corner : corners)
          append_big(to, int32_of(corner + 1));
      }),
      mesh.once(mark(12 * mesh.triangles()))};
  add_record(
      mesh, [numbers](std::size_t row) { return (*numbers)[row]; }, rows);
  add_record(
      mesh, [&data](std::size_t row) { return data.points[row].x; }, rows);
  add_record(
      mesh, [&data](std::size_t row) { return data.points[row].y; }, rows);
  std::string time;
  append_big(time, 0.0);
  rows.push_back(mesh.once(record(time)));
  add_record(
      mesh, [&data](std::size_t row) { return data.depth ? 0.0 - (*data.depth)[row] : 0.0; }, rows);
  return {{path, rows},
          {paths_of(Format::telemac, path, mesh.names())[1], {mesh.once(conditions(rings, open_parts(mesh.names())))}}};
}

} // namespace trime::formats
