// SPDX-License-Identifier: BSD-3-Clause
#include "formats/named_cells.hpp"

#include "comm/outbox.hpp"
#include "formats/rows_by_number.hpp"

#include <algorithm>
#include <memory>
#include <tuple>
#include <vector>

namespace trime::formats {
namespace {

/// An edge with a label, on its way to the rank of its lower end.
struct LabelledEdge {
  std::int64_t label;
  GlobalId lower, upper;
};

/// A cell along an edge, or along all edges of a label.
struct NamedCell {
  std::int64_t label;
  GlobalId cell;
  double length;

  bool is_same_cell(const NamedCell& other) const { return label == other.label && cell == other.cell; }
};

template <class T>
std::vector<T> arrived(const comm::Communicator& comm, const comm::Outbox<T>& away) {
  std::vector<T> values;
  for (const comm::Message& message : comm::send(comm, away)) {
    const std::vector<T> some = comm::from_bytes<T>(message.data);
    values.insert(values.end(), some.begin(), some.end());
  }
  return values;
}

/// The edges with labels whose lower ends are sites of this rank.
std::vector<LabelledEdge> edges_at_sites(const FlowCells& cells) {
  const ExchangeMesh& mesh = cells.mesh()->mesh();
  comm::Outbox<LabelledEdge> away;
  for (std::int64_t row = 0; row < mesh.rank_lines(); ++row) {
    const auto [lower, upper] = std::minmax(mesh.line(row)[0], mesh.line(row)[1]);
    away[cells.mesh()->cells().shares.rank_of(lower)].push_back({mesh.line_label(row), lower, upper});
  }
  return arrived(mesh.comm(), away);
}

/// The cells of this rank along all labelled edges, each once for each label. Equal shares of the cells belong to the
/// ranks, in their order.
std::vector<NamedCell> cells_of_labels(const FlowCells& cells) {
  const comm::Communicator& comm = cells.mesh()->mesh().comm();
  const dual::Shares shares{cells.count(), comm.size()};
  comm::Outbox<NamedCell> away;
  for (const LabelledEdge& edge : edges_at_sites(cells))
    for (const CellLength& at : cells.along_edge(edge.lower, edge.upper))
      away[shares.rank_of(at.cell)].push_back({edge.label, at.cell, at.length});
  std::vector<NamedCell> all = arrived(comm, away);
  std::sort(all.begin(), all.end(), [](const NamedCell& a, const NamedCell& b) { // by length: the same sum on any ranks
    return std::tie(a.label, a.cell, a.length) < std::tie(b.label, b.cell, b.length);
  });
  std::vector<NamedCell> once;
  for (const NamedCell& cell : all)
    if (!once.empty() && once.back().is_same_cell(cell))
      once.back().length += cell.length;
    else
      once.push_back(cell);
  return once;
}

/// A name as a field of a table: in double quotes, and in one line.
std::string in_table(const std::string& name) {
  std::string field = "\"";
  for (const char c : name)
    field += c == '"' ? "\"\"" : c == '\n' || c == '\r' ? " " : std::string(1, c);
  return field + '"';
}

} // namespace

void append_cell_number(GlobalId number, std::string& text) {
  io::append_number(text, number + 1);
}

FilePlan plan_named_cells(const FlowCells& cells, const std::string& path,
                          const std::function<void(GlobalId number, std::string& text)>& append_cell) {
  const ExchangeMesh& mesh = cells.mesh()->mesh();
  const std::size_t labels = mesh.line_names().size();
  const auto named = std::make_shared<const std::vector<NamedCell>>(cells_of_labels(cells));
  const auto by_label = std::make_shared<const RowsByNumber>(
      std::ssize(*named), labels, [&](std::int64_t row) { return (*named)[static_cast<std::size_t>(row)].label; });
  FilePlan plan{path, {mesh.once("label,name,cell,length\n")}};
  for (std::size_t label = 1; label <= labels; ++label)
    plan.rows.push_back(rows_of_number(
        by_label, label,
        [named, append_cell, name = in_table(mesh.line_names()[label - 1])](std::int64_t row, std::string& to) {
          const NamedCell& cell = (*named)[static_cast<std::size_t>(row)];
          io::append_number(to, cell.label);
          to += ',' + name + ',';
          append_cell(cell.cell, to);
          to += ',';
          io::append_number(to, cell.length);
          to += '\n';
        }));
  return plan;
}

} // namespace trime::formats
