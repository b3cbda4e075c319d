// SPDX-License-Identifier: BSD-3-Clause
#include "record/courant.hpp"

#include "io/point_lookup.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trime::record {
namespace {

using geometry::Vec2;
using io::MeshPoint;

constexpr double gravity = 9.81; // [m/s^2]

/// Points of triangles by local index, those of other ranks included.
class Corners {
public:
  Corners(const mesh::DistributedMesh& mesh, const comm::Communicator& comm)
      : mesh_(mesh), foreign_(mesh, mesh.foreign, comm) {}

  MeshPoint operator[](LocalIndex vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    if (v >= mesh_.points.size())
      return foreign_[mesh_.global_id(vertex)];
    return {mesh_.points[v], mesh_.size[v], (*mesh_.depth)[v]};
  }

private:
  const mesh::DistributedMesh& mesh_;
  io::PointLookup foreign_;
};

double mean_depth(const std::array<MeshPoint, 3>& at) {
  return (at[0].depth + at[1].depth + at[2].depth) / 3;
}

double courant_number(double time_step, double depth, const std::array<MeshPoint, 3>& at) {
  const double edge = std::min({length(at[1].position - at[0].position), length(at[2].position - at[1].position),
                                length(at[0].position - at[2].position)});
  return time_step * std::sqrt(gravity * depth) / edge;
}

} // namespace

CourantSummary courant_numbers(const CourantOptions& options, const mesh::DistributedMesh& mesh,
                               const comm::Communicator& comm) {
  CourantSummary summary;
  summary.options = options;
  summary.triangles = mesh.triangle_slab.total;
  const Corners corners(mesh, comm);
  GlobalId worst = std::numeric_limits<GlobalId>::max(); // the first triangle with the largest number
  Vec2 centre{};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const std::array<MeshPoint, 3> at{corners[a], corners[b], corners[c]};
    const double depth = mean_depth(at);
    if (!(depth > 0)) {
      ++summary.dry;
      continue;
    }
    const double number = courant_number(options.time_step, depth, at);
    summary.above += number > options.limit;
    if (number <= summary.largest)
      continue;
    summary.largest = number;
    worst = mesh.triangle_slab.first + static_cast<GlobalId>(t);
    centre = (1 / 3.0) * (at[0].position + at[1].position + at[2].position);
  }
  std::array counts{summary.above, summary.dry};
  comm.sum(counts);
  summary.above = counts[0];
  summary.dry = counts[1];
  const double here = summary.largest;
  summary.largest = comm.max(here);
  const GlobalId first = comm.min(here == summary.largest ? worst : std::numeric_limits<GlobalId>::max());
  constexpr double least = -std::numeric_limits<double>::max();
  std::array<double, 2> place{least, least};
  if (first == worst)
    place = {centre.x, centre.y};
  comm.max(place);
  summary.place = {place[0], place[1]};
  return summary;
}

std::string text_of(const CourantSummary& s) {
  const std::int64_t wet = s.triangles - s.dry;
  const std::string what = fmt::format("Courant numbers with a time step of {:g} s", s.options.time_step);
  if (wet == 0)
    return fmt::format("{}: none, since none of {} triangles has a positive depth in the mean of its corners", what,
                       s.triangles);
  std::string text = fmt::format("{}: {} of {} triangles ({:.3g} %) above {:g}; the largest is {:.3g} at {}", what,
                                 s.above, wet, 100 * static_cast<double>(s.above) / static_cast<double>(wet),
                                 s.options.limit, s.largest, Place(s.place, 6));
  if (s.dry > 0)
    text += fmt::format("; {} dry triangle{} without a positive depth in the mean of {} corners {} not counted", s.dry,
                        s.dry == 1 ? "" : "s", s.dry == 1 ? "its" : "their", s.dry == 1 ? "is" : "are");
  return text;
}

io::MetadataGroup group_of(const CourantSummary& s) {
  return {"courant",
          {{"time_step", s.options.time_step},
           {"limit", s.options.limit},
           {"triangles", s.triangles},
           {"dry", s.dry},
           {"above", s.above},
           {"largest", s.largest},
           {"largest_x", s.place.x},
           {"largest_y", s.place.y}},
          {}};
}

} // namespace trime::record
