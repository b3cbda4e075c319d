// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/patch_sharing.hpp"

#include "comm/neighbours.hpp"
#include "comm/parcel.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace trime::cleanup {
namespace {

/// Stands for a task in a message; the sites follow in another list.
struct TaskHead {
  Contender contender;
  std::int64_t narrowings, sites;
};

/// Stands for a result; its lists follow.
struct ResultHead {
  std::int64_t edits, links, verdicts;
};

void join(auto& all, const auto& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// The next `count` values of a list.
template <class T>
std::vector<T> cut(std::span<const T>& rest, std::int64_t count) {
  const auto next = rest.first(static_cast<std::size_t>(count));
  rest = rest.subspan(next.size());
  return {next.begin(), next.end()};
}

std::vector<std::byte> pack(std::span<const PatchTask> tasks) {
  std::vector<TaskHead> heads;
  std::vector<PatchSite> sites;
  for (const auto& [contender, around] : tasks) {
    heads.push_back({contender, around.narrowings, std::ssize(around.sites)});
    join(sites, around.sites);
  }
  comm::Parcel parcel;
  parcel.add(heads);
  parcel.add(sites);
  return parcel.release();
}

std::vector<PatchTask> unpack_tasks(std::vector<std::byte> data) {
  comm::Parcel parcel(std::move(data));
  const auto heads = parcel.take<TaskHead>();
  const auto sites = parcel.take<PatchSite>();
  std::span<const PatchSite> rest(sites);
  std::vector<PatchTask> tasks;
  for (const TaskHead& head : heads)
    tasks.push_back({head.contender, {static_cast<int>(head.narrowings), cut(rest, head.sites)}});
  return tasks;
}

std::vector<std::byte> pack(std::span<const PatchResult> results) {
  std::vector<ResultHead> heads;
  PatchResult all;
  for (const PatchResult& result : results) {
    heads.push_back({std::ssize(result.edits), std::ssize(result.links), std::ssize(result.verdicts)});
    join(all.edits, result.edits);
    join(all.links, result.links);
    join(all.verdicts, result.verdicts);
  }
  comm::Parcel parcel;
  parcel.add(heads);
  parcel.add(all.edits);
  parcel.add(all.links);
  parcel.add(all.verdicts);
  return parcel.release();
}

void unpack_results(std::vector<std::byte> data, std::vector<PatchResult>& results) {
  comm::Parcel parcel(std::move(data));
  const auto heads = parcel.take<ResultHead>();
  const auto edits = parcel.take<SiteEdit>();
  const auto links = parcel.take<BoundaryLink>();
  const auto verdicts = parcel.take<SiteVerdict>();
  std::span<const SiteEdit> more_edits(edits);
  std::span<const BoundaryLink> more_links(links);
  std::span<const SiteVerdict> more_verdicts(verdicts);
  for (const ResultHead& head : heads)
    results.push_back(
        {cut(more_edits, head.edits), cut(more_links, head.links), cut(more_verdicts, head.verdicts), false});
}

using TasksByRank = std::map<int, std::vector<PatchTask>>;

/// Patch k of all n goes to rank k * ranks / n: near ones to the same rank or the next.
TasksByRank deal_out(const comm::Communicator& comm, std::int64_t patches, std::vector<PatchTask> own) {
  const std::int64_t first = comm.exclusive_scan(std::ssize(own));
  TasksByRank dealt;
  for (std::size_t k = 0; k < own.size(); ++k) {
    const std::int64_t number = first + static_cast<std::int64_t>(k);
    dealt[static_cast<int>(number * comm.size() / patches)].push_back(std::move(own[k]));
  }
  return dealt;
}

/// Another rank, and how many tasks came from there.
struct Guests {
  int rank;
  std::size_t tasks;
};

/// The results of guests go back to their ranks. @param results of the guests, rank by rank
std::vector<comm::Message> replies_to(std::span<const Guests> guests, std::span<const PatchResult> results) {
  std::vector<comm::Message> replies;
  for (const auto& [rank, count] : guests) {
    replies.push_back({rank, pack(results.first(count))});
    results = results.subspan(count);
  }
  return replies;
}

} // namespace

std::vector<PatchResult> try_shared(const comm::Communicator& comm, const PatchCounts& counts,
                                    std::vector<PatchTask> own, const PatchTrial& trial) {
  if (!counts.is_uneven())
    return trial(own);
  const TasksByRank dealt = deal_out(comm, counts.patches, std::move(own));
  std::vector<PatchTask> tasks; // own ones that stay here first
  std::vector<comm::Message> outgoing;
  std::set<int> partners; // who knows of this rank, too
  for (const auto& [rank, list] : dealt)
    if (rank == comm.rank()) {
      tasks = list;
    } else {
      outgoing.push_back({rank, pack(list)});
      partners.insert(rank);
    }
  const std::ptrdiff_t staying = std::ssize(tasks);
  std::vector<Guests> guests;
  for (comm::Message& message : comm.exchange_any(outgoing)) {
    std::vector<PatchTask> arrived = unpack_tasks(std::move(message.data));
    guests.push_back({message.peer, arrived.size()});
    partners.insert(message.peer);
    tasks.insert(tasks.end(), std::move_iterator(arrived.begin()), std::move_iterator(arrived.end()));
  }
  const std::vector<PatchResult> results = trial(tasks);
  const std::vector<comm::Message> replies =
      replies_to(guests, std::span(results).subspan(static_cast<std::size_t>(staying)));
  const std::vector<int> peers(partners.begin(), partners.end());
  std::map<int, std::vector<std::byte>> answers;
  for (comm::Message& message : comm::exchange_among(comm, peers, replies))
    answers[message.peer] = std::move(message.data);
  std::vector<PatchResult> all; // ranks ascend as the numbers of patches do
  for (const auto& [rank, list] : dealt)
    if (rank == comm.rank())
      all.insert(all.end(), results.begin(), results.begin() + staying);
    else
      unpack_results(std::move(answers.at(rank)), all);
  return all;
}

} // namespace trime::cleanup
