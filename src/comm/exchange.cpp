// SPDX-License-Identifier: BSD-3-Clause
// Messages between ranks: with peers that are known, and with peers of which only the sender knows.
#include "comm/mpi_call.hpp"
#include "trime/comm/communicator.hpp"

#include <algorithm>

namespace trime::comm {
namespace {

/// Of two calls of exchange_any in a row the tags differ, see there: the second is one more.
enum Tag : int { tag_known = 101, tag_any = 102 };

/// [bytes] A message up to this size travels whole in the first letter; what MPI libraries send without asking.
constexpr std::size_t letter_bytes = 4096;

void post(const Message& message, bool send, int tag, const Communicator::Native& native,
          std::vector<MPI_Request>& requests) {
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

/// @brief The first word of a sender to somebody who does not expect it: the size of the message, and the message
/// itself if it is short.
std::vector<std::byte> letter_of(const Message& message) {
  const auto size = static_cast<std::int64_t>(message.data.size());
  std::vector<std::byte> letter = to_bytes(std::span(&size, 1));
  if (message.data.size() <= letter_bytes)
    letter.insert(letter.end(), message.data.begin(), message.data.end());
  return letter;
}

/// The message as far as its letter tells it; the data of a long one are still to come.
Message opened(int peer, std::span<const std::byte> letter) {
  const std::size_t head = sizeof(std::int64_t);
  const auto size = static_cast<std::size_t>(from_bytes<std::int64_t>(letter.first(head))[0]);
  Message message{peer, {}};
  if (size <= letter_bytes)
    message.data.assign(letter.begin() + head, letter.end());
  else
    message.data.resize(size);
  return message;
}

/// The letters of one call of exchange_any.
class Letters {
public:
  Letters(const Communicator::Native& native, int tag, const std::vector<Message>& outgoing)
      : native_(native), tag_(tag), room_(sizeof(std::int64_t) + letter_bytes), open_(outgoing.size()),
        requests_(first_letter + outgoing.size(), MPI_REQUEST_NULL) {
    receive();
    for (const Message& message : outgoing) {
      const std::vector<std::byte>& letter = letters_.emplace_back(letter_of(message));
      count_message(native_, message.peer, letter.size());
      check(MPI_Issend(letter.data(), static_cast<int>(letter.size()), MPI_BYTE, message.peer, tag_, native_.comm,
                       &requests_[first_letter + letters_.size() - 1]));
    }
    enter_barrier();
  }

  std::vector<Message> exchange() {
    for (bool all_received = false; !all_received;) {
      int index = 0;
      MPI_Status status;
      check(MPI_Waitany(static_cast<int>(requests_.size()), requests_.data(), &index, &status));
      if (index == arrival) {
        take(status);
        receive();
      } else if (index == barrier) {
        all_received = true;
      } else {
        --open_;
        enter_barrier();
      }
    }
    end_receiving();
    return std::move(incoming_);
  }

private:
  enum Index : int { arrival, barrier, first_letter }; // in requests_

  void receive() {
    check(MPI_Irecv(room_.data(), static_cast<int>(room_.size()), MPI_BYTE, MPI_ANY_SOURCE, tag_, native_.comm,
                    &requests_[arrival]));
  }
  void take(const MPI_Status& status) {
    int bytes = 0;
    check(MPI_Get_count(&status, MPI_BYTE, &bytes));
    incoming_.push_back(opened(status.MPI_SOURCE, std::span(room_).first(static_cast<std::size_t>(bytes))));
  }
  void enter_barrier() {
    if (open_ == 0)
      check(MPI_Ibarrier(collective(native_), &requests_[barrier]));
  }
  /// All letters of all ranks have found their receivers: the last receiver has the last letter, or waits in vain.
  void end_receiving() {
    MPI_Status status;
    int in_vain = 0;
    check(MPI_Cancel(&requests_[arrival]));
    check(MPI_Wait(&requests_[arrival], &status));
    check(MPI_Test_cancelled(&status, &in_vain));
    if (!in_vain)
      take(status);
  }

  const Communicator::Native& native_;
  int tag_;
  std::vector<std::byte> room_; // for one letter
  std::size_t open_;            // own letters that are not received yet
  std::vector<MPI_Request> requests_;
  std::vector<std::vector<std::byte>> letters_;
  std::vector<Message> incoming_;
};

} // namespace

// NBX of Hoefler, Siebert and Lumsdaine (PPoPP 2010): letters by synchronous sends, and a barrier that a rank enters
// when its own have been received. No rank ends a call before all have entered its barrier, so letters of two calls in
// a row may meet, those of three may not: two tags keep them apart.
std::vector<Message> Communicator::exchange_any(const std::vector<Message>& outgoing) const {
  if (size_ == 1)
    return outgoing;
  const int tag = tag_any + (native_->sparse_exchanges++ & 1);
  std::vector<Message> incoming = Letters(*native_, tag, outgoing).exchange();
  std::sort(incoming.begin(), incoming.end(), [](const Message& a, const Message& b) { return a.peer < b.peer; });
  std::vector<MPI_Request> requests;
  for (const Message& message : incoming)
    if (message.data.size() > letter_bytes)
      post(message, false, tag_known, *native_, requests);
  for (const Message& message : outgoing)
    if (message.data.size() > letter_bytes)
      post(message, true, tag_known, *native_, requests);
  check(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE));
  return incoming;
}

void Communicator::exchange_known(std::span<const Message> outgoing, std::span<Message> incoming) const {
  std::vector<MPI_Request> requests;
  for (const Message& message : incoming)
    post(message, false, tag_known, *native_, requests);
  for (const Message& message : outgoing)
    post(message, true, tag_known, *native_, requests);
  check(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE));
}

struct Communicator::Exchange::Requests {
  std::vector<MPI_Request> list;
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
  check(MPI_Waitall(static_cast<int>(requests_->list.size()), requests_->list.data(), MPI_STATUSES_IGNORE));
  requests_.reset();
  outgoing_.clear();
}

Communicator::Exchange Communicator::begin_exchange(std::vector<Message> outgoing, std::span<Message> incoming) const {
  Exchange exchange;
  exchange.requests_ = std::make_unique<Exchange::Requests>();
  exchange.outgoing_ = std::move(outgoing);
  for (const Message& message : incoming)
    post(message, false, tag_known, *native_, exchange.requests_->list);
  for (const Message& message : exchange.outgoing_)
    post(message, true, tag_known, *native_, exchange.requests_->list);
  return exchange;
}

} // namespace trime::comm
