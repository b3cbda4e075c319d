// SPDX-License-Identifier: BSD-3-Clause
// Collects the results of the checks and prints one line per check.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace trime_check {

/// Exit codes of trime_check. Codes that trime_mpi has, too, mean the same there.
enum class ExitCode : int { sound = 0, internal_error = 1, usage = 2, file = 4, damaged = 5 };

/// An error that ends the program before it has judged the file.
class Failure : public std::runtime_error {
public:
  Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

private:
  ExitCode code_;
};

/// How often a check failed, and the first or the worst place.
struct Tally {
  std::int64_t count = 0;
  std::string place;

  /// @param where function that returns the place; it is called only for the first failure
  template <class Where>
  void note(const Where& where) {
    if (count++ == 0)
      place = where();
  }
  /// Adds the failures of another tally.
  void add(const Tally& other) {
    if (count == 0)
      place = other.place;
    count += other.count;
  }
};

/// Collects the checks in the order in which they were made.
class Report {
public:
  /// @param meaning describes in words what was compared
  void add(const std::string& name, bool passed, const std::string& expected, const std::string& found,
           const std::string& meaning, const std::string& place = "");
  /// Adds a check that passes if a count is zero.
  void none(const std::string& name, const Tally& tally, const std::string& meaning);
  /// Adds a check that passes if two numbers are equal.
  void equal(const std::string& name, std::int64_t expected, std::int64_t found, const std::string& meaning,
             const std::string& place = "");
  /// Notes a check that could not be made, and the reason. This is not a failure.
  void skip(const std::string& name, const std::string& reason);

  /// Adds a line with numbers that are not checked.
  void info(const std::string& name, const std::string& text);

  std::string text() const;
  bool all_passed() const { return failed_.empty(); }

private:
  std::vector<std::string> lines_, failed_;
  std::size_t checks_ = 0, skipped_ = 0;
};

} // namespace trime_check
