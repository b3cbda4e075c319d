// SPDX-License-Identifier: BSD-3-Clause
// The kinds of error and the exit code of each. The library throws them; only the program's main catches.
// No rank may throw alone before a collective: see comm/agree.hpp.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>

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

/// Base of all errors that a user can meet; carries the exit code of the program.
class Error : public std::runtime_error {
public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

private:
  ExitCode code_;
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

/// Checks a condition that only a mistake of the program can violate; also in release builds. Further arguments are a
/// format string and values.
#define TRIME_ASSERT(condition, ...)                                                                                   \
  do {                                                                                                                 \
    if (!(condition)) [[unlikely]]                                                                                     \
      ::trime::assertion_failed(#condition, __FILE__, __LINE__, ::fmt::format("" __VA_ARGS__));                        \
  } while (false)
