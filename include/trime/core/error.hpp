// SPDX-License-Identifier: BSD-3-Clause
// Defines the kinds of error, the exit code of each, and the places that errors and messages name. The library throws
// errors, and main of the program catches them. No rank may throw alone before a collective call: see comm/agree.hpp.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace trime {

/// Exit codes of the program. Scripts may rely on them.
enum class ExitCode : int {
  done = 0,
  internal_error = 1,
  usage = 2, ///< wrong command line or config; also a number of points that is too small for the boundary of the shape
  geometry = 3,   ///< the shape cannot be meshed
  file = 4,       ///< a file cannot be read or written
  incomplete = 5, ///< the mesh is written and marked as incomplete: max_sweeps was reached or a check failed
  out_of_memory = 6,
  checkpointed = 75, ///< the run stopped at a checkpoint and can be continued
};

/// @brief A place in the container that a message names: `fmt::format("near {}", Place(p))` gives "near (0.1, 0.2)".
/// Error and Log also keep the place as numbers, so that the program can add where it lies in the files of the user.
/// Use this type only in messages of Error and Log.
struct Place {
  double x = 0, y = 0;
  int digits = 9; ///< significant digits in the text; 0: the shortest text that gives exactly these numbers

  template <class Vector>
  explicit Place(const Vector& p, int significant = 9) : x(p.x), y(p.y), digits(significant) {}
  /// Returns the place in the internal form that PlacedText reads from strings made by fmt::format.
  std::string formatted() const;
};

/// A text together with the places that it names.
class PlacedText {
public:
  struct Named {
    std::size_t end; ///< position in the text just after "(x, y)"
    double x, y;
  };

  /// @param formatted a string made by fmt::format; it may contain formatted Places
  explicit PlacedText(const std::string& formatted);

  /// Returns the text that a person reads.
  const std::string& text() const { return text_; }
  const std::vector<Named>& places() const { return places_; }
  /// Returns the text with the result of `note(x, y)` inserted after each place.
  std::string with_notes(const std::function<std::string(double x, double y)>& note) const;
  /// Returns the string that fmt::format made, for use in another message or on another rank.
  std::string formatted() const;

private:
  std::string text_;
  std::vector<Named> places_;
};

/// Base class of all errors that a user can meet. Holds the exit code of the program, and the places that the message
/// names.
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

/// Thrown if the program itself is wrong (exit 1).
class InternalError : public Error {
public:
  explicit InternalError(const std::string& message) : Error(ExitCode::internal_error, message) {}
};

/// Prints the failed expression, its file and line, and the values, then aborts the process. Called by TRIME_ASSERT.
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

/// Checks a condition that only an error of the program can violate; also in release builds. Further arguments are a
/// format string and values for the message.
#define TRIME_ASSERT(condition, ...)                                                                                   \
  do {                                                                                                                 \
    if (!(condition)) [[unlikely]]                                                                                     \
      ::trime::assertion_failed(#condition, __FILE__, __LINE__, ::fmt::format("" __VA_ARGS__));                        \
  } while (false)
