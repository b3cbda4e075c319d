// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/log.hpp"

#include "trime/core/error.hpp"
#include "trime/core/timer.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace trime {
namespace {

constexpr double redraw_seconds = 0.1; // a person reads no faster
constexpr int usual_columns = 80;

volatile std::sig_atomic_t live_line = 0; // 1 while one stands

/// 1, 2, 5, 10, 20, 50, ...: enough to follow a batch job, too few to fill its file.
long next_sparse_step(long step) {
  long decade = 1;
  while (10 * decade <= step)
    decade *= 10;
  for (const long digit : {1, 2, 5})
    if (digit * decade > step)
      return digit * decade;
  return 10 * decade;
}

std::string target_of(const std::string& link) {
  char target[64] = "";
  return readlink(link.c_str(), target, sizeof target - 1) < 0 ? std::string() : std::string(target);
}

/// The terminal on which a person watches, or none. Under mpirun every process writes to a pseudo-terminal of its
/// launcher, so there the launcher's own output is asked; one on another node, which cannot be asked, counts as none.
std::string terminal_of(std::FILE* stream) {
  const char* kind = std::getenv("TERM");
  if (isatty(fileno(stream)) == 0 || (kind != nullptr && std::string_view(kind) == "dumb"))
    return {};
  const std::string path = std::getenv("OMPI_COMM_WORLD_RANK") == nullptr
                               ? target_of(fmt::format("/proc/self/fd/{}", fileno(stream)))
                               : target_of(fmt::format("/proc/{}/fd/1", getppid()));
  return path.starts_with("/dev/pts/") || path.starts_with("/dev/tty") ? path : std::string();
}

/// Width of the window, which may have changed since the last line.
int columns_of(const std::string& terminal) {
  winsize size{};
  const int file = open(terminal.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0)
    return usual_columns;
  const bool known = ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  close(file);
  return known ? size.ws_col : usual_columns;
}

} // namespace

std::string duration_text(double seconds) {
  if (seconds < 99.5)
    return fmt::format("{:.0f} s", std::fmax(seconds, 1));
  const auto minutes = static_cast<long>(std::llround(seconds / 60));
  return minutes < 100 ? fmt::format("{} min", minutes) : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

bool live_line_stands() noexcept {
  return live_line != 0;
}

Log::Log(LogLevel level, bool active, std::FILE* stream)
    : level_(level), active_(active), terminal_(active ? terminal_of(stream) : std::string()), stream_(stream) {}

void Log::write(LogLevel level, const std::string& message) {
  const bool is_shown = level >= level_, is_warning = level == LogLevel::warning;
  if (!active_ || !(is_shown || is_warning))
    return;
  const PlacedText read(message);
  const std::string text = rewrite_ ? rewrite_(read) : read.text();
  if (is_warning)
    warnings_.push_back(text);
  if (!is_shown)
    return;
  erase_live_line();
  fmt::print(stream_, "{}{}\n", is_warning ? "warning: " : "", text);
  std::fflush(stream_);
}

void Log::phase(const std::string& name) {
  if (!shows_progress() || terminal_.empty() || name == phase_)
    return;
  phase_ = name;
  draw_live_line();
}

void Log::progress(const ProgressStep& step) {
  if (!shows_progress())
    return;
  const bool has_rows = interval_ > 0 || (terminal_.empty() && level_ <= LogLevel::info);
  if (has_rows && (step.is_shown || step.number >= next_row_))
    print_row(step);
  const double now = wall_seconds();
  live_ = step.live;
  end_ = step.seconds_left < 0 ? -1 : now + step.seconds_left;
  if (terminal_.empty() || now - drawn_ < redraw_seconds)
    return;
  drawn_ = now;
  draw_live_line();
}

void Log::print_row(const ProgressStep& step) {
  erase_live_line();
  if (!has_header_)
    fmt::print(stream_, "{}\n", step.header);
  has_header_ = true;
  fmt::print(stream_, "{}\n", step.row);
  std::fflush(stream_);
  next_row_ = interval_ > 0 ? (step.number / interval_ + 1) * interval_ : next_sparse_step(step.number);
}

/// A line that is wider than the window would not be erased as a whole.
void Log::draw_live_line() {
  std::string line = phase_ + (phase_.empty() || live_.empty() ? "" : ": ") + live_;
  if (const double left = end_ - wall_seconds(); left > 0)
    line += fmt::format(", about {} left", duration_text(left));
  line.resize(std::min(line.size(), static_cast<std::size_t>(columns_of(terminal_) - 1)));
  live_line = 1;
  fmt::print(stream_, "{}{}", live_line_eraser, line);
  std::fflush(stream_);
}

void Log::erase_live_line() {
  if (!active_ || terminal_.empty() || live_line == 0)
    return;
  fmt::print(stream_, "{}", live_line_eraser);
  std::fflush(stream_);
  live_line = 0;
}

} // namespace trime
