// SPDX-License-Identifier: BSD-3-Clause
// Patches that are dealt out: each is tried once, with all of its sites, and its result comes back to its place.
#include "cleanup/patch_sharing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trime::cleanup {
namespace {

PatchTask task_of(int rank, int number) {
  const geometry::Vec2 place{static_cast<double>(rank), static_cast<double>(number)};
  PatchTask task{{place, 0.5, static_cast<std::uint64_t>(number)}, {}};
  task.around.narrowings = number % 2;
  for (int k = 0; k < 40 * number; ++k) // some lists are longer than the head of a message
    task.around.sites.push_back({place, static_cast<double>(k)});
  return task;
}

/// As many edits as it has a number, and verdicts that tell what has arrived.
PatchResult result_of(const PatchTask& task) {
  PatchResult result;
  for (std::uint64_t k = 0; k < task.contender.order; ++k)
    result.edits.push_back({.from = task.contender.place, .to = {0.25, static_cast<double>(k)}});
  double sum = task.around.narrowings;
  for (const PatchSite& site : task.around.sites)
    sum += site.size;
  result.verdicts.push_back({task.contender.place, sum, task.contender.separation, 1});
  if (task.contender.order == 3)
    result.links.push_back({task.contender.place, 5, 6});
  return result;
}

/// Has patches tried, of which this rank has `own`. @return how many it tried itself
std::int64_t share(const comm::Communicator& comm, int own) {
  std::vector<PatchTask> tasks;
  for (int k = 0; k < own; ++k)
    tasks.push_back(task_of(comm.rank(), k));
  const PatchCounts counts{comm.sum(std::int64_t{own}), comm.size(), comm.max(std::int64_t{own})};
  std::int64_t tried = 0;
  const std::vector<PatchResult> results = try_shared(comm, counts, tasks, [&](std::span<PatchTask> list) {
    tried += std::ssize(list);
    std::vector<PatchResult> of_list;
    for (const PatchTask& task : list)
      of_list.push_back(result_of(task));
    return of_list;
  });
  EXPECT_EQ(std::ssize(results), own);
  for (std::size_t k = 0; k < results.size(); ++k) {
    const PatchResult expected = result_of(task_of(comm.rank(), static_cast<int>(k)));
    EXPECT_EQ(results[k].edits.size(), expected.edits.size());
    EXPECT_TRUE(std::ranges::equal(results[k].edits, expected.edits, [](const SiteEdit& a, const SiteEdit& b) {
      return a.from == b.from && a.to == b.to;
    }));
    EXPECT_EQ(results[k].links.size(), expected.links.size());
    EXPECT_EQ(results[k].verdicts.size(), 1u);
    EXPECT_EQ(results[k].verdicts.at(0).position, expected.verdicts[0].position) << "of another patch";
    EXPECT_EQ(results[k].verdicts.at(0).size, expected.verdicts[0].size) << "not all of its sites arrived";
  }
  EXPECT_EQ(comm.sum(tried), counts.patches);
  return tried;
}

TEST(PatchSharing, PatchesOfOneRankAreTriedByAll) {
  const auto world = comm::Communicator::world();
  const int last = world.size() - 1, own = world.rank() == last ? 12 : 0;
  EXPECT_LE(share(world, own), (12 + last) / world.size());
}

TEST(PatchSharing, UnevenPatchesOfAllRanksAreTriedByAll) {
  const auto world = comm::Communicator::world();
  const int ranks = world.size(), all = 2 * ranks * (ranks - 1); // 0, 4, 8, ...
  EXPECT_LE(share(world, 4 * world.rank()), (all + ranks - 1) / ranks);
}

TEST(PatchSharing, EvenPatchesStayWhereTheyAre) {
  const auto world = comm::Communicator::world();
  EXPECT_EQ(share(world, 3), 3);
}

/// Two threads have two patches in the time of one.
TEST(PatchSharing, ThreadsCountAsPlacesForPatches) {
  EXPECT_FALSE((PatchCounts{.patches = 4, .threads = 8, .turns = 1}).is_uneven());
  EXPECT_FALSE((PatchCounts{.patches = 9, .threads = 8, .turns = 2}).is_uneven());
  EXPECT_FALSE((PatchCounts{.patches = 8, .threads = 8, .turns = 2}).is_uneven());
  EXPECT_TRUE((PatchCounts{.patches = 8, .threads = 8, .turns = 3}).is_uneven());
}

} // namespace
} // namespace trime::cleanup
