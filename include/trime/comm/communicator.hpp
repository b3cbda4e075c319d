// SPDX-License-Identifier: BSD-3-Clause
// A wrapper of MPI: start and end, a duplicated communicator, and the few collectives that the program uses. Callers
// need no mpi.h. Every MPI error prints its text and ends the job, because nothing can recover from a broken network.
#pragma once

#include "trime/core/timer.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace trime::comm {

/// @brief Initialises MPI (MPI_THREAD_FUNNELED) and finalises it; one object in main. Works without mpirun. Steers Open
/// MPI 4 round its collective file writer `vulcan`, which is known to write wrong data. While an exception unwinds the
/// stack it does not finalise: other ranks may wait in a collective without end, and finalising would wait for them.
class Environment {
public:
  Environment(int& argc, char**& argv);
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
};

/// Returns name and version of the MPI library, in one line.
std::string library_version();

/// Whether the ranks are those of a simulated cluster (TRIME_SIMULATE): they take turns in one process.
bool is_simulated();

/// Ends all processes of the job at once, with this exit code: for an error that one rank has alone.
[[noreturn]] void abort_job(int exit_code);

/// Bytes for one peer, or from one.
struct Message {
  int peer;
  std::vector<std::byte> data;
};

/// @brief A communicator that is duplicated, so that no message meets those of other libraries. Move-only.
class Communicator {
public:
  /// Returns a communicator of all processes of the job. Collective.
  static Communicator world();
  /// Returns a communicator of this process alone.
  static Communicator self();
  /// Returns a communicator of those ranks that share the memory of this node, in the same order. Collective.
  Communicator node() const;
  Communicator(Communicator&&) noexcept;
  Communicator& operator=(Communicator&&) noexcept;
  ~Communicator();

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  /// @brief The counters of this rank. This class counts messages, bytes and collectives; the modules that do the work
  /// count the rest. Nobody counts what HDF5 sends. The reference is valid as long as the communicator.
  Counters& counters() const;

  /// Collective.
  void barrier() const;
  /// These three reduce each element over all ranks, in place. Collective.
  void sum(std::span<std::int64_t> values) const;
  void min(std::span<double> values) const;
  void max(std::span<double> values) const;
  /// Computes sums of the integers and maxima of the doubles in one reduction, in place. Collective.
  void sum_and_max(std::span<std::int64_t> sums, std::span<double> largest) const;
  /// Collective.
  std::int64_t sum(std::int64_t value) const;
  std::int64_t min(std::int64_t value) const;
  std::int64_t max(std::int64_t value) const;
  double min(double value) const;
  double max(double value) const;
  /// Returns the sum over all lower ranks; 0 on rank 0. Collective.
  std::int64_t exclusive_scan(std::int64_t value) const;
  /// Returns the value of each rank, ordered by rank. O(ranks) memory. Collective.
  std::vector<std::int64_t> all_gather(std::int64_t value) const;
  std::vector<double> all_gather(double value) const;
  /// Returns the bytes of all ranks on every rank, ordered by rank. O(all bytes) memory. Collective.
  std::vector<std::byte> all_gather(std::span<const std::byte> bytes) const;
  /// Does the same as all_gather, but returns nothing on all ranks if any rank says that it has failed. Collective.
  std::optional<std::vector<std::byte>> all_gather_unless(bool failed, std::span<const std::byte> bytes) const;
  /// Returns the text of `root` on every rank. Collective.
  std::string broadcast(std::string text, int root = 0) const;
  /// Returns the bytes of `root` on every rank. Collective.
  std::vector<std::byte> broadcast(std::vector<std::byte> bytes, int root = 0) const;
  /// Returns the text of each rank on rank 0, and an empty list elsewhere. Collective.
  std::vector<std::string> gather(const std::string& text) const;

  /// @brief Sends each message to its peer and returns what arrived, ordered by peer. Peers need not know each other
  /// beforehand. There is at most one message per peer. Takes O(log(ranks)) steps. Collective.
  std::vector<Message> exchange_any(const std::vector<Message>& outgoing) const;
  /// @brief Exchanges messages between ranks that know each other: `incoming[k].data` must have room for what its peer
  /// sends. Uses non-blocking sends and receives; empty messages are not sent. Only the named ranks take part.
  void exchange_known(std::span<const Message> outgoing, std::span<Message> incoming) const;

  /// @brief An exchange_known in two steps, so that the rank can work in between: `incoming` must not be touched before
  /// the wait. This object keeps the outgoing messages until then.
  class Exchange {
  public:
    Exchange();
    Exchange(Exchange&&) noexcept;
    Exchange& operator=(Exchange&&) noexcept;
    ~Exchange(); ///< waits
    bool is_open() const;
    void wait();

  private:
    friend class Communicator;
    struct Requests;
    std::unique_ptr<Requests> requests_;
    std::vector<Message> outgoing_;
  };
  Exchange begin_exchange(std::vector<Message> outgoing, std::span<Message> incoming) const;

  /// Implementation handle, for native.hpp.
  struct Native;
  const Native& native() const { return *native_; }

private:
  explicit Communicator(std::unique_ptr<Native> native);
  std::unique_ptr<Native> native_;
  int rank_ = 0, size_ = 1;
};

/// Copies trivially copyable values to bytes, and back.
template <class T>
std::vector<std::byte> to_bytes(std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<std::byte> bytes(values.size_bytes());
  if (!bytes.empty())
    std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}
template <class T>
std::vector<T> from_bytes(std::span<const std::byte> bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty())
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

} // namespace trime::comm
