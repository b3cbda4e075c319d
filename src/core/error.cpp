// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/error.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace trime {
namespace {

// The numbers of a place stand behind its text between two characters that no text has.
constexpr char mark = '\x02', mark_end = '\x03';

std::string marked(double x, double y) {
  return fmt::format("{}{:.17g} {:.17g}{}", mark, x, y, mark_end);
}

/// The numbers between the marks, if they are well-formed.
std::optional<PlacedText::Named> read_mark(std::string_view numbers) {
  PlacedText::Named named{};
  const char* end = numbers.data() + numbers.size();
  const auto x = std::from_chars(numbers.data(), end, named.x);
  if (x.ec != std::errc{} || x.ptr == end || *x.ptr != ' ')
    return std::nullopt;
  const auto y = std::from_chars(x.ptr + 1, end, named.y);
  return y.ec == std::errc{} && y.ptr == end ? std::optional(named) : std::nullopt;
}

/// " on rank 3", as the launcher numbers the processes; empty without a launcher. MPI itself may be the cause of the
/// error, and this module does not know it.
std::string rank_text() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (const char* rank = std::getenv(name))
      return fmt::format(" on rank {}", rank);
  return "";
}

} // namespace

std::string Place::formatted() const {
  const std::string text =
      digits == 0 ? fmt::format("({}, {})", x, y) : fmt::format("({:.{}g}, {:.{}g})", x, digits, y, digits);
  return text + marked(x, y);
}

PlacedText::PlacedText(const std::string& formatted) {
  for (std::size_t at = 0; at < formatted.size();) {
    const std::size_t begin = std::min(formatted.find(mark, at), formatted.size());
    text_.append(formatted, at, begin - at);
    const std::size_t end = std::min(formatted.find(mark_end, begin), formatted.size());
    if (end == formatted.size()) {
      text_.append(formatted, begin);
      return;
    }
    const std::size_t last = formatted.rfind(mark, end); // names of files may have a stray mark before it
    text_.append(formatted, begin, last - begin);
    if (std::optional<Named> named = read_mark(std::string_view(formatted).substr(last + 1, end - last - 1))) {
      named->end = text_.size();
      places_.push_back(*named);
    }
    at = end + 1;
  }
}

std::string PlacedText::with_notes(const std::function<std::string(double x, double y)>& note) const {
  std::string text;
  std::size_t at = 0;
  for (const Named& place : places_) {
    text.append(text_, at, place.end - at);
    text += note(place.x, place.y);
    at = place.end;
  }
  return text.append(text_, at);
}

std::string PlacedText::formatted() const {
  return with_notes(marked);
}

void assertion_failed(const char* expression, const char* file, int line, const std::string& values) {
  fmt::print(stderr,
             "TriMe-MPI: internal error{}: {}:{}: '{}' does not hold. {}\nPlease report this with the config or the "
             "program.\n",
             rank_text(), file, line, expression, values);
  std::fflush(stderr);
  std::abort();
}

} // namespace trime
