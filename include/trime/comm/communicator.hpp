// SPDX-License-Identifier: BSD-3-Clause
// A wrapper of MPI: start and end of MPI, a duplicated communicator, and the few collectives that the program uses.
// Callers do not need mpi.h. Each MPI error prints its text and ends the job, because a program cannot recover from a
// broken network.
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

/// @brief Initialises MPI (MPI_THREAD_FUNNELED) and finalises it; main makes one such object. Works without mpirun.
/// Keeps Open MPI 4 from using its collective file writer `vulcan`, which is known to write wrong data. If an exception
/// ends the program, the destructor does not finalise MPI: other ranks may be waiting in a collective call, and
/// MPI_Finalize would wait for them without end.
class Environment {
public:
  Environment(int& argc, char**& argv);
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
};

/// Returns the name and the version of the MPI library in one line.
std::string library_version();

/// Returns whether the ranks belong to a simulated cluster (environment variable TRIME_SIMULATE): then they run
/// alternately in one process.
bool is_simulated();

/// Ends all processes of the job at once with this exit code, after an error that only one rank has.
[[noreturn]] void abort_job(int exit_code);

/// A message to another rank (peer) or from another rank, as bytes.
struct Message {
  int peer;
  std::vector<std::byte> data;
};

/// @brief A duplicated MPI communicator, so that messages of this library never mix with messages of other libraries.
/// Move-only.
class Communicator {
public:
  /// Returns a communicator of all processes of the job. Collective.
  static Communicator world();
  /// Returns a communicator of this process alone.
  static Communicator self();
  /// Returns a communicator of all ranks on the same node (which share memory), in the same order. Collective.
  Communicator node() const;
  Communicator(Communicator&&) noexcept;
  Communicator& operator=(Communicator&&) noexcept;
  ~Communicator();

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }
  /// @brief The counters of this rank. Communicator counts messages, bytes and collective calls; other modules count
  /// their own work. Messages inside HDF5 are not counted. The reference is valid as long as the communicator exists.
  Counters& counters() const;

  /// Waits until all ranks have called this function. Collective.
  void barrier() const;
  /// Reduces each element over all ranks, in place, by sum, minimum or maximum. Collective.
  void sum(std::span<std::int64_t> values) const;
  void min(std::span<double> values) const;
  void max(std::span<double> values) const;
  /// Computes sums of the integers and maxima of the doubles in one reduction, in place. Collective.
  void sum_and_max(std::span<std::int64_t> sums, std::span<double> largest) const;
  /// Returns the sum, minimum or maximum of a value over all ranks. Collective.
  std::int64_t sum(std::int64_t value) const;
  std::int64_t min(std::int64_t value) const;
  std::int64_t max(std::int64_t value) const;
  double min(double value) const;
  double max(double value) const;
  /// Returns the sum of the values of all lower ranks; 0 on rank 0. Collective.
  std::int64_t exclusive_scan(std::int64_t value) const;
  /// Returns the value of each rank, ordered by rank. Memory: O(ranks). Collective.
  std::vector<std::int64_t> all_gather(std::int64_t value) const;
  std::vector<double> all_gather(double value) const;
  /// Returns the bytes of all ranks on every rank, ordered by rank. Memory: O(all bytes). Collective.
  std::vector<std::byte> all_gather(std::span<const std::byte> bytes) const;
  /// Does the same as all_gather, but returns nothing on all ranks if any rank passes failed = true. Collective.
  std::optional<std::vector<std::byte>> all_gather_unless(bool failed, std::span<const std::byte> bytes) const;
  /// Returns the text of `root` on every rank. Collective.
  std::string broadcast(std::string text, int root = 0) const;
  /// Returns the bytes of `root` on every rank. Collective.
  std::vector<std::byte> broadcast(std::vector<std::byte> bytes, int root = 0) const;
  /// Returns the text of each rank on rank 0, and an empty list elsewhere. Collective.
  std::vector<std::string> gather(const std::string& text) const;

  /// @brief Sends each message to its peer, and returns the received messages, ordered by peer. A receiver need not
  /// know the senders beforehand. Each rank sends at most one message to each peer. Takes O(log(ranks)) steps.
  /// Collective.
  std::vector<Message> exchange_any(const std::vector<Message>& outgoing) const;
  /// @brief Exchanges messages between ranks that expect each other's messages: `incoming[k].data` must have the size
  /// of the message that its peer sends. Uses non-blocking sends and receives; empty messages are not sent. Only the
  /// named ranks must call this function.
  void exchange_known(std::span<const Message> outgoing, std::span<Message> incoming) const;

  /// @brief An exchange_known in two steps, so that the rank can compute between them. `incoming` must not be touched
  /// before wait() returns; this object keeps the outgoing messages until then.
  class Exchange {
  public:
    Exchange();
    Exchange(Exchange&&) noexcept;
    Exchange& operator=(Exchange&&) noexcept;
    ~Exchange(); ///< waits for the end of the exchange
    bool is_open() const;
    void wait();

  private:
    friend class Communicator;
    struct Requests;
    std::unique_ptr<Requests> requests_;
    std::vector<Message> outgoing_;
  };
  Exchange begin_exchange(std::vector<Message> outgoing, std::span<Message> incoming) const;

  /// The MPI handle, which only native.hpp uses.
  struct Native;
  const Native& native() const { return *native_; }

private:
  explicit Communicator(std::unique_ptr<Native> native);
  std::unique_ptr<Native> native_;
  int rank_ = 0, size_ = 1;
};

/// Copy trivially copyable values to bytes, and back.
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
