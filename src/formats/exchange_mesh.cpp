// SPDX-License-Identifier: BSD-3-Clause
#include "formats/exchange_mesh.hpp"

#include "comm/agree.hpp"

#include <algorithm>
#include <limits>

namespace trime::formats {
namespace {

/// A point of another rank, or of this one, and the label of an edge at it.
struct PointLabel {
  GlobalId point;
  std::int64_t label;
};

void check_range(std::int64_t number, std::size_t count, const char* what) {
  if (number < 0 || number >= static_cast<std::int64_t>(count))
    throw FileError(
        fmt::format("the mesh uses the number {1} of a {0}, but has only {2} names for that, so it cannot be written",
                    what, number, count));
}

} // namespace

ExchangeMesh::ExchangeMesh(const mesh::DistributedMesh& mesh, const Names& names, const comm::Communicator& comm)
    : mesh_(mesh), names_(names), comm_(comm) {
  line_names_ = names.parts;
  line_names_.insert(line_names_.end(), names.curves.begin(), names.curves.end());
  line_names_.insert(line_names_.end(), names.interfaces.begin(), names.interfaces.end());
  comm::run_agreed(comm, [&] { check_numbers(); });
  lines_ = io::labelled_lines(mesh, names.parts.size(), names.curves.size(), comm);
  count();
  label_points();
}

void ExchangeMesh::check_numbers() const {
  for (const std::int32_t part : mesh_.facet_parts)
    check_range(part, names_.parts.size() + names_.curves.size(), "part"); // curves may be split
  for (const std::int32_t curve : mesh_.curve_numbers)
    check_range(curve, names_.curves.size(), "curve");
  for (const std::int32_t pair : mesh_.interface_pairs)
    check_range(pair, names_.interfaces.size(), "interface");
  for (std::int64_t row = 0; row < std::ssize(mesh_.triangles); ++row)
    check_range(region(row) - 1, names_.regions.size(), "region");
}

void ExchangeMesh::count() {
  constexpr double huge = std::numeric_limits<double>::max();
  std::array<double, 2> least{huge, huge}, most{-huge, -huge};
  lines_of_.assign(line_names_.size(), 0);
  triangles_of_region_.assign(names_.regions.size(), 0);
  for (std::int64_t row = 0; row < rank_lines(); ++row)
    ++lines_of_[static_cast<std::size_t>(line_label(row) - 1)];
  for (std::int64_t row = 0; row < std::ssize(mesh_.triangles); ++row)
    ++triangles_of_region_[static_cast<std::size_t>(region(row) - 1)];
  for (const geometry::Vec2 p : mesh_.points) {
    least = {std::min(least[0], p.x), std::min(least[1], p.y)};
    most = {std::max(most[0], p.x), std::max(most[1], p.y)};
  }
  comm_.sum(lines_of_);
  comm_.sum(triangles_of_region_);
  comm_.min(least);
  comm_.max(most);
  lower_ = {least[0], least[1]};
  upper_ = {most[0], most[1]};
}

/// Ranks send messages about labelled edges to the owners of their points.
void ExchangeMesh::label_points() {
  const std::vector<std::int64_t> firsts = comm_.all_gather(mesh_.point_slab.first);
  std::vector<PointLabel> labels;
  for (std::int64_t row = 0; row < rank_lines(); ++row)
    for (const GlobalId point : line(row))
      labels.push_back({point, line_label(row)});
  std::sort(labels.begin(), labels.end(), [](const PointLabel& a, const PointLabel& b) {
    return a.point != b.point ? a.point < b.point : a.label < b.label;
  });
  std::vector<comm::Message> outgoing;
  for (std::size_t begin = 0, end = 0; begin < labels.size(); begin = end) {
    const auto next = std::upper_bound(firsts.begin(), firsts.end(), labels[begin].point);
    end =
        next == firsts.end()
            ? labels.size()
            : static_cast<std::size_t>(std::lower_bound(labels.begin(), labels.end(), *next,
                                                        [](const PointLabel& a, GlobalId id) { return a.point < id; }) -
                                       labels.begin());
    outgoing.push_back({static_cast<int>(next - firsts.begin()) - 1,
                        comm::to_bytes(std::span<const PointLabel>(labels).subspan(begin, end - begin))});
  }
  point_labels_.assign(mesh_.points.size(), 0);
  for (const comm::Message& message : comm_.exchange_any(outgoing))
    for (const PointLabel& at : comm::from_bytes<PointLabel>(message.data)) {
      std::int32_t& label = point_labels_.at(static_cast<std::size_t>(at.point - mesh_.point_slab.first));
      if (label == 0 || at.label < label)
        label = static_cast<std::int32_t>(at.label);
    }
}

io::TextRows ExchangeMesh::once(std::string text) const {
  return {comm_.is_root() ? 1 : 0, [text = std::move(text)](std::int64_t, std::string& to) { to += text; }};
}

} // namespace trime::formats
