// SPDX-License-Identifier: BSD-3-Clause
// Messages of the program: only rank 0 prints, at or above one level; a progress line that updates in place on a
// terminal and is printed sparsely elsewhere.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <string>

namespace trime {

enum class LogLevel { debug, info, warning, error, silent };

class Log {
public:
  /// Prints to `stream` when `active` (true on rank 0 only) and the level suffices.
  Log(LogLevel level, bool active, std::FILE* stream = stdout);

  template <class... A>
  void debug(fmt::format_string<A...> f, A&&... a) {
    write(LogLevel::debug, fmt::format(f, std::forward<A>(a)...));
  }
  template <class... A>
  void info(fmt::format_string<A...> f, A&&... a) {
    write(LogLevel::info, fmt::format(f, std::forward<A>(a)...));
  }
  template <class... A>
  void warning(fmt::format_string<A...> f, A&&... a) {
    write(LogLevel::warning, fmt::format(f, std::forward<A>(a)...));
  }

  /// One line about sweep number `step`. On a terminal it replaces the last one. Elsewhere only every `interval`-th
  /// step is printed (interval 0: steps 1, 2, 5, 10, 20, 50, ...), and those with `force`.
  void progress(long step, const std::string& line, bool force = false);
  void set_progress_interval(int interval) { interval_ = interval; }
  /// From now on each message but progress lines is printed as `rewrite` returns it.
  void set_rewriter(std::function<std::string(const std::string&)> rewrite) { rewrite_ = std::move(rewrite); }

private:
  void write(LogLevel level, const std::string& message);
  void end_progress_line();

  LogLevel level_;
  bool active_;
  bool terminal_;
  bool progress_open_ = false;
  int interval_ = 0;
  std::FILE* stream_;
  std::function<std::string(const std::string&)> rewrite_; ///< none: messages are printed as they are
};

} // namespace trime
