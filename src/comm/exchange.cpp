// SPDX-License-Identifier: BSD-3-Clause
// Messages between ranks that know each other, and from ranks that only the sender knows about.
#include "comm/mpi_call.hpp"
#include "comm/parcel.hpp"
#include "trime/comm/communicator.hpp"

#include <algorithm>
#include <functional>

namespace trime::comm {
namespace {

/// [bytes] A message up to this size travels in the bundles of exchange_any, passed on from rank to rank; of a longer
/// one only the size. So nothing long travels more than once.
constexpr std::size_t most_passed_on = 4096;

void post(const Message& message, bool send, int tag, const Communicator::Native& native,
          std::vector<MPI_Request>& requests) {
  const InMpi in_mpi;
  for (std::size_t offset = 0; offset < message.data.size(); offset += piece_bytes) {
    const int count = static_cast<int>(std::min(piece_bytes, message.data.size() - offset));
    std::byte* start = const_cast<std::byte*>(message.data.data()) + offset; // MPI receives through the same path
    requests.emplace_back();
    if (send)
      count_message(native, message.peer, static_cast<std::size_t>(count));
    check(send ? MPI_Isend(start, count, MPI_BYTE, message.peer, tag, native.comm, &requests.back())
               : MPI_Irecv(start, count, MPI_BYTE, message.peer, tag, native.comm, &requests.back()));
  }
}

void wait_for(std::vector<MPI_Request>& requests, const Communicator::Native& native) {
  const Wait wait(native);
  check(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE));
}

/// The header of each message in a bundle.
struct Envelope {
  std::int32_t from, to;
  std::int64_t size; // of the message; its bytes follow if they are passed on
  std::size_t bytes_inside() const {
    return size <= static_cast<std::int64_t>(most_passed_on) ? static_cast<std::size_t>(size) : 0;
  }
};

using Bundle = std::vector<std::byte>; // envelopes, each with its bytes

void add(Bundle& bundle, const Envelope& envelope, std::span<const std::byte> inside) {
  const auto head = std::as_bytes(std::span(&envelope, 1));
  bundle.insert(bundle.end(), head.begin(), head.end());
  bundle.insert(bundle.end(), inside.begin(), inside.end());
}

/// Calls visit(envelope, bytes inside) for each message.
template <class Visit>
void for_each_message(std::span<const std::byte> bundle, const Visit& visit) {
  while (!bundle.empty()) {
    const Envelope envelope = from_bytes<Envelope>(bundle.first(sizeof(Envelope)))[0];
    visit(envelope, bundle.subspan(sizeof(Envelope), envelope.bytes_inside()));
    bundle = bundle.subspan(sizeof(Envelope) + envelope.bytes_inside());
  }
}

/// Passes bundles on until each message is where it belongs.
class Router {
public:
  Router(const Communicator& comm, Bundle bundle) : comm_(comm), native_(comm.native()), bundle_(std::move(bundle)) {}

  Bundle route() {
    for (int first = 0, count = comm_.size(); count > 1;) { // ranks among which the own bundle must arrive
      const int lower = (count + 1) / 2, upper = count - lower, middle = first + lower, rank = comm_.rank();
      const bool is_lower = rank < middle;
      const bool is_odd_one = rank - first >= upper; // the last of the lower half, if that is one longer
      Bundle away = take_away(middle, is_lower);
      std::vector<int> sources;
      int target = is_lower ? rank + lower : rank - lower;
      if (is_lower && is_odd_one)
        target = first + count - 1; // which has a partner, too
      else
        sources.push_back(target);
      if (lower > upper && rank == first + count - 1)
        sources.push_back(middle - 1);
      swap(target, away, sources);
      first = is_lower ? first : middle;
      count = is_lower ? lower : upper;
    }
    return std::move(bundle_);
  }

private:
  /// Takes what belongs to the other half out of the bundle.
  Bundle take_away(int middle, bool is_lower) {
    Bundle away, kept;
    for_each_message(bundle_, [&](const Envelope& envelope, std::span<const std::byte> inside) {
      add((envelope.to < middle) == is_lower ? kept : away, envelope, inside);
    });
    bundle_ = std::move(kept);
    return away;
  }

  /// One message each way; a second one of what does not fit into its head.
  void swap(int target, const Bundle& away, const std::vector<int>& sources) {
    std::vector<Message> incoming, rests;
    for (const int source : sources)
      incoming.push_back({source, Bundle(head_bytes)});
    const Message head{target, head_of(away)};
    exchange(head, tag_head, incoming);
    for (Message& message : incoming)
      rests.push_back({message.peer, Bundle(open_head(message.data))});
    const std::span<const std::byte> more = rest_of(away);
    exchange({target, {more.begin(), more.end()}}, tag_bundle, rests);
    for (std::size_t k = 0; k < incoming.size(); ++k)
      for (const Bundle& part : {std::cref(incoming[k].data), std::cref(rests[k].data)})
        bundle_.insert(bundle_.end(), part.begin(), part.end());
  }

  /// Empty messages are not sent. What arrives may be shorter than the room for it.
  void exchange(const Message& outgoing, int tag, const std::vector<Message>& incoming) const {
    std::vector<MPI_Request> requests;
    for (const Message& message : incoming)
      post(message, false, tag, native_, requests);
    post(outgoing, true, tag, native_, requests);
    wait_for(requests, native_);
  }

  const Communicator& comm_;
  const Communicator::Native& native_;
  Bundle bundle_;
};

} // namespace

// The crystal router of Fox et al. (Solving Problems on Concurrent Processors, 1988): the ranks are halved again and
// again, and each rank sends everything for the other half to a partner there. It takes log2(ranks) steps, needs no
// table of ranks, and does not depend on the order in which ranks arrive.
std::vector<Message> Communicator::exchange_any(const std::vector<Message>& outgoing) const {
  if (size_ == 1)
    return outgoing;
  collective(*native_);
  Bundle bundle;
  for (const Message& message : outgoing) {
    const Envelope envelope{rank_, message.peer, std::ssize(message.data)};
    add(bundle, envelope, std::span(message.data).first(envelope.bytes_inside()));
  }
  std::vector<Message> incoming;
  for_each_message(Router(*this, std::move(bundle)).route(),
                   [&](const Envelope& envelope, std::span<const std::byte> inside) {
                     incoming.push_back({envelope.from, {inside.begin(), inside.end()}});
                     incoming.back().data.resize(static_cast<std::size_t>(envelope.size));
                   });
  std::sort(incoming.begin(), incoming.end(), [](const Message& a, const Message& b) { return a.peer < b.peer; });
  const auto is_long = [](const Message& message) { return message.data.size() > most_passed_on; };
  std::vector<MPI_Request> requests;
  for (const Message& message : incoming)
    if (is_long(message))
      post(message, false, tag_known, *native_, requests);
  for (const Message& message : outgoing)
    if (is_long(message))
      post(message, true, tag_known, *native_, requests);
  wait_for(requests, *native_);
  return incoming;
}

void Communicator::exchange_known(std::span<const Message> outgoing, std::span<Message> incoming) const {
  std::vector<MPI_Request> requests;
  for (const Message& message : incoming)
    post(message, false, tag_known, *native_, requests);
  for (const Message& message : outgoing)
    post(message, true, tag_known, *native_, requests);
  wait_for(requests, *native_);
}

struct Communicator::Exchange::Requests {
  std::vector<MPI_Request> list;
  const Native* native;
};

Communicator::Exchange::Exchange() = default;
Communicator::Exchange::Exchange(Exchange&&) noexcept = default;
Communicator::Exchange& Communicator::Exchange::operator=(Exchange&& other) noexcept {
  std::swap(requests_, other.requests_);
  std::swap(outgoing_, other.outgoing_);
  return *this;
}
Communicator::Exchange::~Exchange() {
  wait(); // MPI must not write to memory that is gone
}

bool Communicator::Exchange::is_open() const {
  return requests_ != nullptr;
}

void Communicator::Exchange::wait() {
  if (!requests_)
    return;
  wait_for(requests_->list, *requests_->native);
  requests_.reset();
  outgoing_.clear();
}

Communicator::Exchange Communicator::begin_exchange(std::vector<Message> outgoing, std::span<Message> incoming) const {
  Exchange exchange;
  exchange.requests_ = std::make_unique<Exchange::Requests>();
  exchange.requests_->native = native_.get();
  exchange.outgoing_ = std::move(outgoing);
  for (const Message& message : incoming)
    post(message, false, tag_known, *native_, exchange.requests_->list);
  for (const Message& message : exchange.outgoing_)
    post(message, true, tag_known, *native_, exchange.requests_->list);
  return exchange;
}

} // namespace trime::comm
