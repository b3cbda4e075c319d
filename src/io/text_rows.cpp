// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_rows.hpp"

#include "comm/agree.hpp"
#include "core/thread_loop.hpp"
#include "io/temporary_file.hpp"
#include "trime/io/mesh_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

namespace trime::io {
namespace {

constexpr std::int64_t rows_at_once = 1 << 17; // over all ranks: about 15 MB of text
constexpr std::int64_t rows_of_thread = 1 << 11;

/// Rank 0's end of the file.
class Output {
public:
  Output(const std::string& final_path, RunFiles* files)
      : final_path_(final_path), temporary_(temporary_name(final_path), files),
        descriptor_(open(temporary_.path().c_str(), O_NOFOLLOW | O_WRONLY | O_CLOEXEC)) {
    if (descriptor_ < 0)
      throw FileError(fmt::format("cannot create {}: {}", temporary_.path(), system_error()));
  }
  ~Output() {
    if (descriptor_ >= 0)
      ::close(descriptor_);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void write(std::int64_t offset, const std::byte* data, std::size_t bytes) const {
    while (bytes > 0) {
      const ssize_t written = pwrite(descriptor_, data, bytes, offset);
      if (written < 0 && errno == EINTR)
        continue;
      if (written <= 0)
        throw FileError(fmt::format("cannot write {}: {}", temporary_.path(), system_error()));
      data += written;
      offset += written;
      bytes -= static_cast<std::size_t>(written);
    }
  }

  void publish() {
    if (::close(std::exchange(descriptor_, -1)) != 0)
      throw FileError(fmt::format("cannot write {}: {}", temporary_.path(), system_error()));
    temporary_.publish(final_path_);
  }

private:
  std::string final_path_;
  TemporaryFile temporary_;
  int descriptor_;
};

/// Lines of rows [first, first + count), in pieces, one after the other.
std::vector<std::string> lines(const TextRows& array, std::int64_t first, std::int64_t count) {
  std::vector<std::string> pieces(static_cast<std::size_t>((count + rows_of_thread - 1) / rows_of_thread));
  thread_loop(static_cast<std::ptrdiff_t>(pieces.size()), 1, [&](std::ptrdiff_t piece, int) {
    const std::int64_t begin = first + piece * rows_of_thread, end = std::min(begin + rows_of_thread, first + count);
    for (std::int64_t row = begin; row < end; ++row)
      array.append(row, pieces[static_cast<std::size_t>(piece)]);
  });
  return pieces;
}

std::int64_t bytes_of(const std::vector<std::string>& pieces) {
  std::int64_t bytes = 0;
  for (const std::string& piece : pieces)
    bytes += static_cast<std::int64_t>(piece.size());
  return bytes;
}

/// Bytes of all lines of this rank.
std::int64_t count_bytes(const TextRows& array, std::int64_t slice) {
  std::int64_t bytes = 0;
  for (std::int64_t first = 0; first < array.rows; first += slice)
    bytes += bytes_of(lines(array, first, std::min(slice, array.rows - first)));
  return bytes;
}

/// Place in the file, then the text: what a rank sends to rank 0.
std::vector<std::byte> packed(std::int64_t offset, const std::vector<std::string>& pieces) {
  std::vector<std::byte> data(sizeof offset + static_cast<std::size_t>(bytes_of(pieces)));
  std::memcpy(data.data(), &offset, sizeof offset);
  std::byte* to = data.data() + sizeof offset;
  for (const std::string& piece : pieces) {
    std::memcpy(to, piece.data(), piece.size());
    to += piece.size();
  }
  return data;
}

void write_packed(const Output& output, const std::vector<std::byte>& data) {
  std::int64_t offset = 0;
  std::memcpy(&offset, data.data(), sizeof offset);
  output.write(offset, data.data() + sizeof offset, data.size() - sizeof offset);
}

/// Appends one array from `start` on. @return the end of it. `output` is there on rank 0 only.
std::int64_t write_array(const TextRows& array, std::int64_t start, const Output* output,
                         const comm::Communicator& comm) {
  const std::int64_t slice = std::max<std::int64_t>(rows_at_once / comm.size(), 64);
  std::int64_t own = 0;
  if (comm.size() > 1)
    comm::run_agreed(comm, [&] { own = count_bytes(array, slice); });
  std::int64_t offset = start + comm.exclusive_scan(own);
  const std::int64_t longest = comm.max(array.rows);
  for (std::int64_t first = 0; first < longest; first += slice) {
    std::vector<comm::Message> outgoing;
    comm::run_agreed(comm, [&] {
      if (first >= array.rows)
        return;
      outgoing.push_back({0, packed(offset, lines(array, first, std::min(slice, array.rows - first)))});
      offset += static_cast<std::int64_t>(outgoing[0].data.size() - sizeof offset);
    });
    const std::vector<comm::Message> incoming = comm.exchange_any(outgoing);
    comm::run_agreed(comm, [&] {
      for (const comm::Message& message : incoming)
        write_packed(*output, message.data);
    });
  }
  return comm.max(offset); // that of the last rank with rows; the others have theirs before it
}

} // namespace

void append_number(std::string& text, double number) {
  char digits[32];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 17);
  text.append(digits, end);
}

void append_number(std::string& text, std::int64_t number) {
  char digits[24];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, number);
  text.append(digits, end);
}

void write_text_rows(const std::string& final_path, std::span<const TextRows> arrays, RunFiles* files,
                     const comm::Communicator& comm) {
  std::optional<Output> output;
  comm::run_agreed(comm, [&] {
    if (comm.is_root())
      output.emplace(final_path, files);
  });
  std::int64_t end = 0;
  for (const TextRows& array : arrays)
    end = write_array(array, end, output ? &*output : nullptr, comm);
  comm::run_agreed(comm, [&] {
    if (output)
      output->publish();
  });
}

} // namespace trime::io
