// SPDX-License-Identifier: BSD-3-Clause
// Messages of the program: only rank 0 prints, at or above one level. What a run is doing stands in one live line on a
// terminal, and in sparse rows of a table elsewhere.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <string>

namespace trime {

enum class LogLevel { debug, info, warning, error, silent };

/// A step of a run, as it is shown.
struct ProgressStep {
  long number = 0;
  std::string live;         ///< for the live line
  std::string header;       ///< of the table; printed once
  std::string row;          ///< of the table
  double seconds_left = -1; ///< to the end of the run, about; negative: unknown
  bool is_shown = false;    ///< its row is printed, be the interval what it may
};

class Log {
public:
  /// Prints to `stream` when `active` (true on rank 0 only) and the level suffices.
  Log(LogLevel level, bool active, std::FILE* stream = stdout);
  ~Log() { erase_live_line(); }
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

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

  /// The live line begins with this word from now on; nothing elsewhere than on a terminal.
  void phase(const std::string& name);
  /// @brief Renews the live line, at most ten times a second. Elsewhere than on a terminal, and with an interval,
  /// prints a row: of the first step at or after each multiple of the interval; of 1, 2, 5, 10, 20, 50, ... for
  /// interval 0.
  void progress(const ProgressStep& step);
  void set_progress_interval(int interval) { interval_ = interval; }
  /// From now on each message but progress is printed as `rewrite` returns it.
  void set_rewriter(std::function<std::string(const std::string&)> rewrite) { rewrite_ = std::move(rewrite); }

private:
  bool shows_progress() const { return active_ && level_ <= LogLevel::info; }
  void write(LogLevel level, const std::string& message);
  void print_row(const ProgressStep& step);
  void draw_live_line();
  void erase_live_line();

  LogLevel level_;
  bool active_;
  std::string terminal_; ///< path of the terminal on which a person watches; empty: none
  int interval_ = 0;
  long next_row_ = 1; ///< step
  bool has_header_ = false;
  std::string phase_, live_; ///< parts of the live line
  double end_ = -1;          ///< expected, by wall_seconds(); negative: unknown
  double drawn_ = -1;        ///< when the live line was, by wall_seconds()
  std::FILE* stream_;
  std::function<std::string(const std::string&)> rewrite_; ///< none: messages are printed as they are
};

/// "12 s", "3 min", "2 h 10 min": as exact as a forecast is.
std::string duration_text(double seconds);

/// @brief True while a live line stands on the terminal. Who writes past the log, as a handler of signals does, writes
/// live_line_eraser to the standard output first. May be called from a handler.
bool live_line_stands() noexcept;
inline constexpr char live_line_eraser[] = "\r\033[K";

} // namespace trime
