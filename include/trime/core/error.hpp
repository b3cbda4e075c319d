// SPDX-License-Identifier: BSD-3-Clause
// The kinds of error and the exit code of each, and the places that errors and messages name. The library throws
// errors, which end in the program's main. No rank may throw alone before a collective: see comm/agree.hpp.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace trime {

/// Exit codes of the program. They are part of its interface.
enum class ExitCode : int {
  done = 0,
  internal_error = 1,
  usage = 2,      ///< command line or config; also fewer points than the boundary of the shape takes
  geometry = 3,   ///< the shape cannot be meshed
  file = 4,       ///< a file cannot be read or written
  incomplete = 5, ///< the mesh is written and marked: max_sweeps was reached or a check failed
  out_of_memory = 6,
  checkpointed = 75, ///< the run stopped at a checkpoint and can be continued
};

/// @brief A place of the container that a message names: `fmt::format("near {}", Place(p))` gives "near (0.1, 0.2)".
/// An error, or the log, keeps the place as numbers, too, for the program, which adds where it lies in the files of the
/// user. Use it only for the messages of these two.
struct Place {
  double x = 0, y = 0;
  int digits = 9; ///< significant digits in the text; 0: the fewest that give these numbers

  template <class Vector>
  explicit Place(const Vector& p, int significant = 9) : x(p.x), y(p.y), digits(significant) {}
  /// The place as it stands in a string on its way from fmt::format to PlacedText.
  std::string formatted() const;
};

/// A text and the places that it names.
class PlacedText {
public:
  struct Named {
    std::size_t end; ///< position after "(x, y)" in the text
    double x, y;
  };

  /// @param formatted made by fmt::format, with or without Places
  explicit PlacedText(const std::string& formatted);

  /// Returns what a person reads.
  const std::string& text() const { return text_; }
  const std::vector<Named>& places() const { return places_; }
  /// Returns the text with `note(x, y)` behind each place.
  std::string with_notes(const std::function<std::string(double x, double y)>& note) const;
  /// Returns what fmt::format made, for another message or for another rank.
  std::string formatted() const;

private:
  std::string text_;
  std::vector<Named> places_;
};

/// Base of all errors that a user can meet; carries the exit code of the program, and the places that it names.
class Error : public std::runtime_error {
public:
  Error(ExitCode code, const std::string& message) : Error(code, PlacedText(message)) {}
  Error(ExitCode code, PlacedText message)
      : std::runtime_error(message.text()), code_(code), message_(std::move(message)) {}
  ExitCode code() const { return code_; }
  const PlacedText& message() const { return message_; }

private:
  ExitCode code_;
  PlacedText message_;
};

/// The command line, config or options are wrong (exit 2).
class ConfigError : public Error {
public:
  explicit ConfigError(const std::string& message) : Error(ExitCode::usage, message) {}
};

/// The shape cannot be meshed (exit 3).
class GeometryError : public Error {
public:
  explicit GeometryError(const std::string& message) : Error(ExitCode::geometry, message) {}
};

/// A file cannot be read or written (exit 4).
class FileError : public Error {
public:
  explicit FileError(const std::string& message) : Error(ExitCode::file, message) {}
};

/// The program has made a mistake (exit 1).
class InternalError : public Error {
public:
  explicit InternalError(const std::string& message) : Error(ExitCode::internal_error, message) {}
};

/// Prints expression, place and values, then aborts the process. Used through TRIME_ASSERT.
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line, const std::string& values);

} // namespace trime

/// @cond
template <>
struct fmt::formatter<trime::Place> {
  constexpr auto parse(fmt::format_parse_context& context) { return context.begin(); }
  template <class Context>
  auto format(const trime::Place& place, Context& context) const {
    const std::string text = place.formatted();
    return std::copy(text.begin(), text.end(), context.out());
  }
};
/// @endcond

/// Checks a condition that only a mistake of the program can violate; also in release builds. Further arguments are a
/// format string and values.
#define TRIME_ASSERT(condition, ...)                                                                                   \
  do {                                                                                                                 \
    if (!(condition)) [[unlikely]]                                                                                     \
      ::trime::assertion_failed(#condition, __FILE__, __LINE__, ::fmt::format("" __VA_ARGS__));                        \
  } while (false)
