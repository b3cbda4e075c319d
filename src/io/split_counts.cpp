// SPDX-License-Identifier: BSD-3-Clause
#include "io/split_counts.hpp"

#include "comm/agree.hpp"
#include "io/hdf5_input.hpp"
#include "trime/core/types.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace trime::io {
namespace {

/// The number of points of the pairs less the number of their places. Points that pairs join share a place.
std::int64_t count_copies(const std::vector<std::array<GlobalId, 2>>& pairs) {
  std::vector<GlobalId> points;
  for (const std::array<GlobalId, 2>& pair : pairs)
    points.insert(points.end(), pair.begin(), pair.end());
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<std::size_t> joined_to(points.size());
  std::iota(joined_to.begin(), joined_to.end(), std::size_t{0});
  const auto root = [&](GlobalId point) {
    auto at = static_cast<std::size_t>(std::lower_bound(points.begin(), points.end(), point) - points.begin());
    while (joined_to[at] != at)
      at = joined_to[at] = joined_to[joined_to[at]];
    return at;
  };
  std::int64_t copies = 0;
  for (const std::array<GlobalId, 2>& pair : pairs)
    if (const std::size_t left = root(pair[0]), right = root(pair[1]); left != right) {
      joined_to[right] = left;
      ++copies;
    }
  return copies;
}

} // namespace

SplitCounts count_splits(const std::string& path, const comm::Communicator& comm) {
  std::array<std::int64_t, 3> counts{0, 0, 0};
  comm::run_agreed(comm, [&] {
    if (!comm.is_root())
      return;
    const Hdf5Input file(path);
    if (!file.has("/Mesh/splits/pairs"))
      return;
    counts[0] = file.rows("/Mesh/splits/pairs");
    std::vector<std::array<GlobalId, 2>> pairs(static_cast<std::size_t>(counts[0]));
    file.read("/Mesh/splits/pairs", H5T_NATIVE_INT64, 2, 0, counts[0], pairs.data());
    std::vector<std::int32_t> paths(static_cast<std::size_t>(file.rows("/Mesh/splits/paths")));
    file.read("/Mesh/splits/paths", H5T_NATIVE_INT32, 0, 0, std::ssize(paths), paths.data());
    std::sort(paths.begin(), paths.end());
    counts[1] = std::unique(paths.begin(), paths.end()) - paths.begin();
    counts[2] = count_copies(pairs);
  });
  comm.sum(counts);
  return {counts[0], counts[1], counts[2]};
}

} // namespace trime::io
