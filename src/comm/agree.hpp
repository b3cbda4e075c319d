// SPDX-License-Identifier: BSD-3-Clause
// Functions for work in which all ranks take part. If one rank has an error, all ranks throw the same error, so that no
// rank waits in a collective call for a rank that has left. Other functions let ranks and threads compute shares of
// results that every rank needs, and find out whether all ranks have arrived.
#pragma once

#include "core/thread_loop.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace trime::comm {

/// @brief If any rank passes an error, all ranks throw the error of the lowest such rank. The message names this rank,
/// unless it is rank 0 or the only rank. Collective; without errors it takes one integer reduction.
void agree(const Communicator& comm, const std::optional<Error>& error);

/// @brief Runs `work` and returns the error that it threw, or nothing. Exceptions that are not an Error are converted
/// to one: std::bad_alloc gets exit code 6, any other exit code 1.
std::optional<Error> error_of(const std::function<void()>& work);

/// @brief Runs `work`, which must not communicate. If it throws on any rank, all ranks throw the error of the lowest
/// such rank. Collective.
void run_agreed(const Communicator& comm, const std::function<void()>& work);

/// Returns the values of all ranks, one rank after the other, on every rank. Collective.
template <class T>
std::vector<T> gather_everywhere(const Communicator& comm, std::vector<T> mine) {
  if (comm.size() == 1)
    return mine;
  return from_bytes<T>(comm.all_gather(std::as_bytes(std::span<const T>(mine))));
}

/// @brief Calls work() on each rank, which returns a std::vector<T>. Returns all results, one after the other, on every
/// rank. Collective.
/// @param work does not communicate; if it throws, all ranks throw the same error
template <class T, class Work>
std::vector<T> gather_agreed(const Communicator& comm, const Work& work) {
  std::vector<T> mine;
  const std::optional<Error> error = error_of([&] { mine = work(); });
  if (comm.size() == 1 && !error)
    return mine;
  const auto all = comm.all_gather_unless(error.has_value(), std::as_bytes(std::span<const T>(mine)));
  if (!all)
    agree(comm, error); // throws
  return from_bytes<T>(*all);
}

/// @brief Does the work of gather_in_order on all ranks together: each rank calls make(k, list) for a contiguous share
/// of k = 0 .. n-1. Returns all lists, joined in the order of k, on every rank. Collective.
/// @param chunk number of successive k that one thread takes at a time
/// @param make thread-safe, does not communicate; if it throws, all ranks throw the same error
template <class T, class Make>
std::vector<T> gather_shared(const Communicator& comm, std::ptrdiff_t n, std::ptrdiff_t chunk, const Make& make) {
  const std::ptrdiff_t first = n * comm.rank() / comm.size(), last = n * (comm.rank() + 1) / comm.size();
  return gather_agreed<T>(comm, [&] {
    return gather_in_order<T>(last - first, chunk,
                              [&](std::ptrdiff_t k, std::vector<T>& list) { make(first + k, list); });
  });
}

/// @brief Returns n results of type T on every rank. Calls work(first, last, results) for runs of `run` results. The
/// runs do not depend on ranks and threads, so `work` may carry values from one result of a run to the next. Each rank
/// computes a contiguous share of the runs. Collective.
/// @param work thread-safe, does not communicate; if it throws, all ranks throw the same error
template <class T, class Work>
std::vector<T> compute_shared_runs(const Communicator& comm, std::size_t n, std::size_t run, const Work& work) {
  const auto ranks = static_cast<std::size_t>(comm.size()), rank = static_cast<std::size_t>(comm.rank());
  const std::size_t runs = (n + run - 1) / run, first = runs * rank / ranks, last = runs * (rank + 1) / ranks;
  return gather_agreed<T>(comm, [&] {
    std::vector<T> mine(std::min(n, last * run) - std::min(n, first * run));
    thread_loop(static_cast<std::ptrdiff_t>(last - first), 1, [&](std::ptrdiff_t k, int) {
      const std::size_t from = (first + static_cast<std::size_t>(k)) * run;
      work(from, std::min(n, from + run), &mine[from - first * run]);
    });
    return mine;
  });
}

/// @brief Returns work(k) of type T for k = 0 .. n-1 on every rank. Collective.
/// @param work thread-safe, does not communicate; if it throws, all ranks throw the same error
template <class T, class Work>
std::vector<T> compute_shared(const Communicator& comm, std::size_t n, const Work& work) {
  return compute_shared_runs<T>(comm, n, 256, [&](std::size_t first, std::size_t last, T* result) {
    for (std::size_t k = first; k < last; ++k)
      *result++ = work(k);
  });
}

/// @brief Returns true on all ranks if all of them call this function within `seconds`. A rank that waits in another
/// collective call does not arrive, so the result is false. After the result false, the caller may only call abort_job.
/// @param comm a communicator that is used only for this call
bool all_arrive(const Communicator& comm, double seconds);

} // namespace trime::comm
