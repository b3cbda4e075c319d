// SPDX-License-Identifier: BSD-3-Clause
#include "record/size_shares.hpp"

#include "comm/agree.hpp"
#include "core/thread_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <span>

namespace trime::record {
namespace {

constexpr std::ptrdiff_t points_at_once = 1024; // by one thread

/// Adds the points of one block to the count of the size that each has.
class BlockCounter {
public:
  explicit BlockCounter(const CombinedSize& size) : size_(size) {}

  void count(std::span<const geometry::Vec2> places, std::vector<std::int64_t>& counts) const {
    std::vector<std::size_t> smallest(places.size());
    std::vector<double> least(places.size()), sizes(places.size());
    size_.minimum->smallest_fields(places, smallest, least);
    if (!size_.lowered_by.empty())
      size_.field->sizes(places, sizes);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const bool is_lowered = !size_.lowered_by.empty() && sizes[k] < least[k];
      ++counts[is_lowered ? size_.names.size() : smallest[k]];
    }
  }

private:
  const CombinedSize& size_;
};

} // namespace

SizeShares shares_of_sizes(const CombinedSize& size, const mesh::DistributedMesh& mesh,
                           const comm::Communicator& comm) {
  if (size.minimum == nullptr)
    return {};
  std::vector<std::string> names = size.names;
  if (!size.lowered_by.empty())
    names.push_back(size.lowered_by);
  std::vector<std::int64_t> points(names.size(), 0);
  comm::run_agreed(comm, [&] {
    const BlockCounter counter(size);
    const std::span<const geometry::Vec2> all(mesh.points);
    const std::ptrdiff_t blocks = (std::ssize(all) + points_at_once - 1) / points_at_once;
    PerThread<std::vector<std::int64_t>> counts(points);
    thread_loop(blocks, 1, [&](std::ptrdiff_t block, int thread) {
      const auto first = static_cast<std::size_t>(block * points_at_once);
      counter.count(all.subspan(first, std::min<std::size_t>(points_at_once, all.size() - first)), counts[thread]);
    });
    for (const std::vector<std::int64_t>& its : counts)
      std::ranges::transform(points, its, points.begin(), std::plus<>());
  });
  comm.sum(points);
  return {std::move(names), std::move(points)};
}

std::string text_of(const SizeShares& shares) {
  if (shares.names.empty())
    return {};
  const std::int64_t all = std::accumulate(shares.points.begin(), shares.points.end(), std::int64_t{0});
  std::string text;
  for (std::size_t k = 0; k < shares.names.size(); ++k)
    text +=
        fmt::format("{}[{}] {:.3g} %", k == 0 ? "" : ", ", shares.names[k],
                    100 * static_cast<double>(shares.points[k]) / static_cast<double>(std::max<std::int64_t>(1, all)));
  return text + " of the points";
}

io::MetadataGroup group_of(const SizeShares& shares) {
  return {"sizes", {}, {{"name", shares.names}, {"points", shares.points}}};
}

std::vector<SizeShare> shares_of(const io::Metadata& metadata) {
  const char* table = "sizes";
  std::vector<SizeShare> shares;
  if (io::find_group(metadata, table) == nullptr)
    return shares;
  const auto& names = io::column_of<std::string>(metadata, table, "name");
  const auto& points = io::column_of<std::int64_t>(metadata, table, "points");
  for (std::size_t k = 0; k < names.size(); ++k)
    shares.push_back({names[k], points.at(k)});
  return shares;
}

} // namespace trime::record
