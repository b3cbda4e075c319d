// SPDX-License-Identifier: BSD-3-Clause
#include "trime/comm/communicator.hpp"

#include "comm/mpi_call.hpp"
#include "comm/running_mpi.hpp"
#include "trime/comm/from_mpi.hpp"
#include "trime/core/timer.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <exception>
#include <numeric>

namespace trime::comm {
namespace {

std::unique_ptr<Communicator::Native> duplicate(MPI_Comm comm) {
  const InMpi in_mpi;
  auto native = std::make_unique<Communicator::Native>();
  check(MPI_Comm_dup(comm, &native->comm));
  check(MPI_Comm_set_errhandler(native->comm, MPI_ERRORS_RETURN));
  return native;
}

template <class T>
void reduce_in_place(std::span<T> values, MPI_Datatype type, MPI_Op op, const Communicator::Native& native) {
  if (values.empty())
    return;
  const Wait wait(native);
  check(MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), type, op, collective(native)));
}

double mpi_seconds() {
  const InMpi in_mpi;
  return MPI_Wtime();
}

} // namespace

void abort_job(int exit_code) {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

#ifdef SMPI_H // SimGrid's MPI
bool is_simulated() {
  return true;
}
#else
bool is_simulated() {
  return false;
}
#endif

namespace {

const Environment* owner = nullptr; // who started MPI; like MPI itself, it is there once in a process

} // namespace

Environment::Environment(int& argc, char**& argv) {
  if (mpi_is_running()) {
    join_running_mpi();
    return;
  }
  avoid_wrong_writer();
  int provided = MPI_THREAD_SINGLE;
  check(MPI_Init_thread(&argc, &argv, needed_thread_level, &provided));
  set_wall_clock(mpi_seconds);
  if (provided < needed_thread_level) {
    fmt::print(stderr, "trime_mpi: this MPI gives thread level {}, at least MPI_THREAD_FUNNELED is needed\n", provided);
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitCode::internal_error));
  }
  owner = this;
  begin_simulated_work();
}

Environment::~Environment() {
  if (owner != this || std::uncaught_exceptions() > 0 || !mpi_is_running())
    return;
  end_simulated_work();
  MPI_Finalize();
}

std::string library_version() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  check(MPI_Get_library_version(text, &length));
  const std::string version(text, static_cast<std::size_t>(length));
  return version.substr(0, version.find_first_of(",\n"));
}

Communicator Communicator::world() {
  join_running_mpi();
  return Communicator(duplicate(MPI_COMM_WORLD));
}
Communicator Communicator::self() {
  return Communicator(duplicate(MPI_COMM_SELF));
}

Communicator Communicator::Native::duplicate_of(MPI_Comm comm) {
  return Communicator(duplicate(comm));
}
Communicator duplicate_of(MPI_Comm comm) {
  check_usable(comm);
  join_running_mpi();
  return Communicator::Native::duplicate_of(comm);
}

Communicator Communicator::node() const {
  const InMpi in_mpi;
  auto native = std::make_unique<Native>();
  check(MPI_Comm_split_type(collective(*native_), MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &native->comm));
  check(MPI_Comm_set_errhandler(native->comm, MPI_ERRORS_RETURN));
  return Communicator(std::move(native));
}

Communicator::Communicator(std::unique_ptr<Native> native) : native_(std::move(native)) {
  check(MPI_Comm_rank(native_->comm, &rank_));
  native_->rank = rank_;
  check(MPI_Comm_size(native_->comm, &size_));
}
Communicator::Communicator(Communicator&&) noexcept = default;
Communicator& Communicator::operator=(Communicator&& other) noexcept {
  std::swap(native_, other.native_);
  std::swap(rank_, other.rank_);
  std::swap(size_, other.size_);
  return *this;
}
Communicator::~Communicator() {
  if (native_ && native_->comm != MPI_COMM_NULL && std::uncaught_exceptions() == 0 && mpi_is_running()) {
    const InMpi in_mpi;
    MPI_Comm_free(&native_->comm);
  }
}

Counters& Communicator::counters() const {
  return native_->counters;
}

void Communicator::barrier() const {
  const Wait wait(*native_);
  check(MPI_Barrier(collective(*native_)));
}

void Communicator::sum(std::span<std::int64_t> values) const {
  reduce_in_place(values, MPI_INT64_T, MPI_SUM, *native_);
}
void Communicator::min(std::span<double> values) const {
  reduce_in_place(values, MPI_DOUBLE, MPI_MIN, *native_);
}
void Communicator::max(std::span<double> values) const {
  reduce_in_place(values, MPI_DOUBLE, MPI_MAX, *native_);
}

namespace {

/// Reduces blocks of words: the number of words, the number of integers among them, these integers, which it sums, and
/// doubles, where it keeps the largest.
void sum_and_max_of_blocks(void* in, void* inout, int* blocks, MPI_Datatype*) {
  const auto* from = static_cast<const std::int64_t*>(in);
  auto* to = static_cast<std::int64_t*>(inout);
  for (int block = 0; block < *blocks; ++block, from += from[0], to += to[0])
    for (std::int64_t k = 2; k < from[0]; ++k)
      if (k < 2 + from[1])
        to[k] += from[k];
      else
        to[k] = std::bit_cast<std::int64_t>(std::max(std::bit_cast<double>(to[k]), std::bit_cast<double>(from[k])));
}

} // namespace

void Communicator::sum_and_max(std::span<std::int64_t> sums, std::span<double> largest) const {
  if (size_ == 1)
    return;
  std::vector<std::int64_t> words{static_cast<std::int64_t>(2 + sums.size() + largest.size()),
                                  static_cast<std::int64_t>(sums.size())};
  words.insert(words.end(), sums.begin(), sums.end());
  for (const double value : largest)
    words.push_back(std::bit_cast<std::int64_t>(value));
  MPI_Datatype block = MPI_DATATYPE_NULL;
  MPI_Op reduce = MPI_OP_NULL;
  check(MPI_Type_contiguous(static_cast<int>(words.size()), MPI_INT64_T, &block));
  check(MPI_Type_commit(&block));
  check(MPI_Op_create(sum_and_max_of_blocks, 1, &reduce));
  {
    const Wait wait(*native_);
    check(MPI_Allreduce(MPI_IN_PLACE, words.data(), 1, block, reduce, collective(*native_)));
  }
  check(MPI_Op_free(&reduce));
  check(MPI_Type_free(&block));
  std::copy_n(words.begin() + 2, sums.size(), sums.begin());
  for (std::size_t k = 0; k < largest.size(); ++k)
    largest[k] = std::bit_cast<double>(words[2 + sums.size() + k]);
}

std::int64_t Communicator::sum(std::int64_t value) const {
  reduce_in_place(std::span(&value, 1), MPI_INT64_T, MPI_SUM, *native_);
  return value;
}
std::int64_t Communicator::min(std::int64_t value) const {
  reduce_in_place(std::span(&value, 1), MPI_INT64_T, MPI_MIN, *native_);
  return value;
}
std::int64_t Communicator::max(std::int64_t value) const {
  reduce_in_place(std::span(&value, 1), MPI_INT64_T, MPI_MAX, *native_);
  return value;
}
double Communicator::min(double value) const {
  min(std::span(&value, 1));
  return value;
}
double Communicator::max(double value) const {
  max(std::span(&value, 1));
  return value;
}

std::int64_t Communicator::exclusive_scan(std::int64_t value) const {
  const Wait wait(*native_);
  const MPI_Comm comm = collective(*native_);
  std::int64_t before =
      0; // not by MPI_Exscan: ranks take turns in that of Open MPI, and send to all others in SimGrid's
  for (int distance = 1; distance < size_;
       distance *= 2) { // then `before + value` sums `distance` ranks up to this one
    const int lower = rank_ >= distance ? rank_ - distance : MPI_PROC_NULL;
    const int higher = rank_ + distance < size_ ? rank_ + distance : MPI_PROC_NULL;
    const std::int64_t sum = before + value;
    std::int64_t theirs = 0;
    check(MPI_Sendrecv(&sum, 1, MPI_INT64_T, higher, tag_scan, &theirs, 1, MPI_INT64_T, lower, tag_scan, comm,
                       MPI_STATUS_IGNORE));
    before += theirs;
  }
  return before;
}

std::vector<std::int64_t> Communicator::all_gather(std::int64_t value) const {
  std::vector<std::int64_t> all = table_of_ranks<std::int64_t>(*this);
  const Wait wait(*native_);
  check(MPI_Allgather(&value, 1, MPI_INT64_T, all.data(), 1, MPI_INT64_T, collective(*native_)));
  return all;
}
std::vector<double> Communicator::all_gather(double value) const {
  std::vector<double> all = table_of_ranks<double>(*this);
  const Wait wait(*native_);
  check(MPI_Allgather(&value, 1, MPI_DOUBLE, all.data(), 1, MPI_DOUBLE, collective(*native_)));
  return all;
}

std::vector<std::byte> Communicator::all_gather(std::span<const std::byte> bytes) const {
  return *all_gather_unless(false, bytes);
}

std::optional<std::vector<std::byte>> Communicator::all_gather_unless(bool failed,
                                                                      std::span<const std::byte> bytes) const {
  if (size_ == 1)
    return failed ? std::nullopt : std::optional<std::vector<std::byte>>({bytes.begin(), bytes.end()});
  constexpr std::int64_t no_size = -1; // of a rank that has failed
  const std::vector<std::int64_t> sizes = all_gather(failed ? no_size : std::ssize(bytes));
  if (std::find(sizes.begin(), sizes.end(), no_size) != sizes.end())
    return std::nullopt;
  const std::int64_t own_start = std::accumulate(sizes.begin(), sizes.begin() + rank_, std::int64_t{0});
  const std::int64_t total = std::accumulate(sizes.begin() + rank_, sizes.end(), own_start);
  std::vector<std::byte> all(static_cast<std::size_t>(total));
  std::vector<int> counts(sizes.size()), starts(sizes.size());
  for (std::int64_t window = 0; window < total; window += piece_bytes) { // MPI counts are int
    const auto within = [&](std::int64_t offset) {
      return std::clamp(offset - window, std::int64_t{0}, std::int64_t{piece_bytes});
    };
    std::int64_t start = 0;
    for (std::size_t rank = 0; rank < sizes.size(); start += sizes[rank++]) {
      starts[rank] = static_cast<int>(within(start));
      counts[rank] = static_cast<int>(within(start + sizes[rank]) - within(start));
    }
    const std::int64_t sent = std::clamp(window - own_start, std::int64_t{0}, std::ssize(bytes)); // in earlier windows
    const Wait wait(*native_);
    check(MPI_Allgatherv(bytes.data() + sent, counts[static_cast<std::size_t>(rank_)], MPI_BYTE, all.data() + window,
                         counts.data(), starts.data(), MPI_BYTE, collective(*native_)));
  }
  return all;
}

namespace {

/// The list of `root`, of values of one byte, on every rank.
template <class List>
void broadcast_list(List& list, int root, const Communicator::Native& native) {
  const Wait wait(native);
  std::int64_t length = std::ssize(list);
  check(MPI_Bcast(&length, 1, MPI_INT64_T, root, collective(native)));
  list.resize(static_cast<std::size_t>(length));
  for (std::size_t offset = 0; offset < list.size(); offset += piece_bytes)
    check(MPI_Bcast(list.data() + offset, static_cast<int>(std::min(piece_bytes, list.size() - offset)), MPI_BYTE, root,
                    collective(native)));
}

} // namespace

std::string Communicator::broadcast(std::string text, int root) const {
  broadcast_list(text, root, *native_);
  return text;
}
std::vector<std::byte> Communicator::broadcast(std::vector<std::byte> bytes, int root) const {
  broadcast_list(bytes, root, *native_);
  return bytes;
}

std::vector<std::string> Communicator::gather(const std::string& text) const {
  std::vector<Message> outgoing;
  if (!is_root() && !text.empty())
    outgoing.push_back({0, to_bytes(std::span<const char>(text))});
  const std::vector<Message> incoming = exchange_any(outgoing);
  std::vector<std::string> all;
  if (is_root()) {
    all.resize(static_cast<std::size_t>(size_));
    all[0] = text;
    for (const Message& message : incoming)
      all[static_cast<std::size_t>(message.peer)].assign(reinterpret_cast<const char*>(message.data.data()),
                                                         message.data.size());
  }
  return all;
}

} // namespace trime::comm
