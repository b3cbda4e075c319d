// SPDX-License-Identifier: BSD-3-Clause
// The log: prints messages at or above a level, on rank 0 only. On a terminal it shows the progress of a run in its
// last line, which it overwrites (the live line); to other outputs it prints some rows of a table.
#pragma once

#include <fmt/core.h>

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace trime {

class PlacedText;

/// The importance of a message, ascending: `info` has the details of each phase of a run, `summary` its result.
enum class LogLevel { debug, info, summary, warning, error, silent };

/// One step of a run, in the forms in which the log can show it.
struct ProgressStep {
  long number = 0;
  std::string live;         ///< text of the live line
  std::string header;       ///< header of the table; printed once
  std::string row;          ///< row of the table for this step
  double seconds_left = -1; ///< estimated seconds to the end of the run; negative: unknown
  bool is_shown = false;    ///< prints the row of this step regardless of the interval
};

/// Prints messages and progress. Not thread-safe.
class Log {
public:
  /// Prints to `stream` if `active` (true on rank 0 only) and the level of the message is at least `level`.
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
  void summary(fmt::format_string<A...> f, A&&... a) {
    write(LogLevel::summary, fmt::format(f, std::forward<A>(a)...));
  }
  template <class... A>
  void warning(fmt::format_string<A...> f, A&&... a) {
    write(LogLevel::warning, fmt::format(f, std::forward<A>(a)...));
  }

  /// Sets the first word of the progress line on a terminal. Does nothing if the output is not a terminal.
  void phase(const std::string& name);
  /// @brief Updates the progress line of a terminal, at most ten times a second, and prints rows of the table. If an
  /// interval is set, a row is printed for the first step at or after each multiple of it. If none is set, rows are
  /// printed for the steps 1, 2, 5, 10, 20, 50, ..., but only if the level is at most `info` and the output is not a
  /// terminal.
  void progress(const ProgressStep& step);
  void set_progress_interval(int interval) { interval_ = interval; }
  /// Returns all warnings so far, also those that the level hides; none unless the log is active.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// From now on the log passes each message, except progress, to `rewrite` and prints the result.
  void set_rewriter(std::function<std::string(const PlacedText&)> rewrite) { rewrite_ = std::move(rewrite); }

private:
  bool shows_progress() const { return active_ && level_ <= LogLevel::summary; }
  void write(LogLevel level, const std::string& message);
  void print_row(const ProgressStep& step);
  void draw_live_line();
  void erase_live_line();

  LogLevel level_;
  bool active_;
  std::string terminal_; ///< path of the terminal on which a person watches; empty: no terminal
  int interval_ = 0;
  long next_row_ = 1; ///< number of the next step for which a row is printed
  bool has_header_ = false;
  std::string phase_, live_; ///< first word and remaining text of the progress line
  double end_ = -1;          ///< expected end of the run, as a time of wall_seconds(); negative: unknown
  double drawn_ = -1;        ///< time of wall_seconds() at which the progress line was last drawn
  std::FILE* stream_;
  std::vector<std::string> warnings_;                     ///< as they are printed
  std::function<std::string(const PlacedText&)> rewrite_; ///< empty: messages are printed as they are
};

/// Returns a duration as "12 s", "3 min" or "2 h 10 min", rounded because it is an estimate.
std::string duration_text(double seconds);

/// @brief Returns true while a progress line is shown on the terminal. Code that writes to the standard output without
/// the log, such as a signal handler, must first write live_line_eraser. May be called from a signal handler.
bool live_line_stands() noexcept;
inline constexpr char live_line_eraser[] = "\r\033[K";

} // namespace trime
