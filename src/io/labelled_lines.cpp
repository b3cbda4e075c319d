// SPDX-License-Identifier: BSD-3-Clause
#include "io/labelled_lines.hpp"

#include "comm/outbox.hpp"

#include <algorithm>

namespace trime::io {
namespace {

/// An edge on its way to the rank that lists it.
struct Line {
  GlobalId row;
  std::array<GlobalId, 2> ends;
  std::int64_t label;
};

/// The edges of this rank, each with its row in the list of all ranks.
struct RankLines {
  std::vector<Line> lines;
  std::int64_t total = 0;
};

RankLines lines_of_rank(const mesh::DistributedMesh& mesh, std::size_t parts, std::size_t curves,
                        const comm::Communicator& comm) {
  RankLines made;
  const auto add = [&](GlobalId row, const std::array<GlobalId, 2>& ends, std::size_t names_before,
                       std::int32_t number) {
    made.lines.push_back({row, ends, static_cast<std::int64_t>(names_before) + number + 1});
  };
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    add(mesh.facet_slab.first + static_cast<GlobalId>(k), mesh.facets[k], 0, mesh.facet_parts[k]);
  made.total = mesh.facet_slab.total;
  for (std::size_t k = 0; k < mesh.curve_edges.size(); ++k)
    add(made.total + mesh.curve_slab.first + static_cast<GlobalId>(k), mesh.curve_edges[k], parts,
        mesh.curve_numbers[k]);
  made.total += mesh.curve_slab.total;
  if (mesh.interface_slab.total == 0)
    return made;
  const std::int64_t listed = std::count(mesh.interface_curves.begin(), mesh.interface_curves.end(), -1);
  GlobalId row = made.total + comm.exclusive_scan(listed);
  for (std::size_t k = 0; k < mesh.interfaces.size(); ++k)
    if (mesh.interface_curves[k] == -1)
      add(row++, mesh.interfaces[k], parts + curves, mesh.interface_pairs[k]);
  made.total += comm.sum(listed);
  return made;
}

/// Gives each rank an equal share of the rows, in their order.
std::vector<Line> shared_out(const RankLines& of_rank, const comm::Communicator& comm) {
  const auto rank_of = [&](GlobalId row) { // the last one whose share begins at this row or before it
    return static_cast<int>(((row + 1) * comm.size() - 1) / of_rank.total);
  };
  comm::Outbox<Line> away;
  for (const Line& line : of_rank.lines)
    away[rank_of(line.row)].push_back(line);
  std::vector<Line> shared;
  for (const comm::Message& message : comm::send(comm, away)) {
    const std::vector<Line> lines = comm::from_bytes<Line>(message.data);
    shared.insert(shared.end(), lines.begin(), lines.end());
  }
  std::ranges::sort(shared, {}, &Line::row);
  return shared;
}

} // namespace

LabelledLines labelled_lines(const mesh::DistributedMesh& mesh, std::size_t parts, std::size_t curves,
                             const comm::Communicator& comm) {
  RankLines of_rank = lines_of_rank(mesh, parts, curves, comm);
  LabelledLines made{{mesh.facet_slab.first, of_rank.total}, {}, {}};
  if (of_rank.total > mesh.facet_slab.total) {
    made.slab.first = of_rank.total * comm.rank() / comm.size();
    if (comm.size() > 1)
      of_rank.lines = shared_out(of_rank, comm);
  }
  for (const Line& line : of_rank.lines) {
    made.ends.push_back(line.ends);
    made.labels.push_back(static_cast<std::int32_t>(line.label));
  }
  return made;
}

} // namespace trime::io
