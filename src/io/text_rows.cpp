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
constexpr std::int64_t rows_together = 1 << 14; // of short arrays over all ranks, see write_together

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

/// A text of one rank for one of the arrays that are written together.
struct Piece {
  std::int64_t array, bytes;
};

/// The texts of this rank for all arrays: the number of pieces, the pieces, then their bytes. Empty if all texts are
/// empty.
std::vector<std::byte> packed_together(std::span<const TextRows> arrays) {
  std::vector<std::string> texts(arrays.size());
  thread_loop(std::ssize(arrays), 1, [&](std::ptrdiff_t k, int) {
    const TextRows& array = arrays[static_cast<std::size_t>(k)];
    for (std::int64_t row = 0; row < array.rows; ++row)
      array.append(row, texts[static_cast<std::size_t>(k)]);
  });
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < texts.size(); ++k)
    if (!texts[k].empty())
      pieces.push_back({static_cast<std::int64_t>(k), std::ssize(texts[k])});
  std::vector<std::byte> data;
  if (pieces.empty())
    return data;
  const auto append = [&data](const void* bytes, std::size_t size) {
    const auto* from = static_cast<const std::byte*>(bytes);
    data.insert(data.end(), from, from + size);
  };
  const std::int64_t count = std::ssize(pieces);
  append(&count, sizeof count);
  append(pieces.data(), pieces.size() * sizeof(Piece));
  for (const std::string& text : texts)
    append(text.data(), text.size());
  return data;
}

/// Joins the texts of all ranks: array by array, and in each array rank by rank.
std::vector<std::byte> joined(const std::vector<comm::Message>& messages) {
  struct Text {
    Piece piece;
    const std::byte* from;
  };
  std::vector<Text> texts;
  for (const comm::Message& message : messages) { // ascending by rank
    std::int64_t count = 0;
    std::memcpy(&count, message.data.data(), sizeof count);
    const std::byte* piece = message.data.data() + sizeof count;
    const std::byte* from = piece + static_cast<std::size_t>(count) * sizeof(Piece);
    for (std::int64_t k = 0; k < count; ++k, piece += sizeof(Piece)) {
      Text& text = texts.emplace_back(Text{{}, from});
      std::memcpy(&text.piece, piece, sizeof(Piece));
      from += text.piece.bytes;
    }
  }
  std::stable_sort(texts.begin(), texts.end(),
                   [](const Text& a, const Text& b) { return a.piece.array < b.piece.array; });
  std::vector<std::byte> bytes;
  for (const Text& text : texts)
    bytes.insert(bytes.end(), text.from, text.from + text.piece.bytes);
  return bytes;
}

/// Appends several arrays with few rows from `start` on, in one exchange: a file may have thousands of them, and a
/// separate exchange for each would take most of the time. @return the end of them
std::int64_t write_together(std::span<const TextRows> arrays, std::int64_t start, const Output* output,
                            const comm::Communicator& comm) {
  std::vector<comm::Message> outgoing;
  comm::run_agreed(comm, [&] {
    std::vector<std::byte> data = packed_together(arrays);
    if (!data.empty())
      outgoing.push_back({0, std::move(data)});
  });
  const std::vector<comm::Message> incoming = comm.exchange_any(outgoing);
  std::int64_t end = start;
  comm::run_agreed(comm, [&] {
    if (incoming.empty())
      return;
    const std::vector<std::byte> bytes = joined(incoming);
    output->write(start, bytes.data(), bytes.size());
    end += std::ssize(bytes);
  });
  return comm.max(end); // rank 0 knows it
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
  const Output* const file = output ? &*output : nullptr;
  std::vector<std::int64_t> rows; // of each array over all ranks
  for (const TextRows& array : arrays)
    rows.push_back(array.rows);
  comm.sum(rows);
  std::int64_t end = 0;
  for (std::size_t first = 0, next = 0; first < arrays.size(); first = next) {
    std::int64_t together = 0;
    for (; next < arrays.size() && together + rows[next] <= rows_together; ++next)
      together += rows[next];
    if (next > first)
      end = write_together(arrays.subspan(first, next - first), end, file, comm);
    else
      end = write_array(arrays[next++], end, file, comm);
  }
  comm::run_agreed(comm, [&] {
    if (output)
      output->publish();
  });
}

} // namespace trime::io
