// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/log.hpp"

#include <unistd.h>

namespace trime {
namespace {

/// 1, 2, 5, 10, 20, 50, ...: enough to follow a batch job, too few to fill its file.
bool is_sparse_step(long step) {
  while (step >= 10 && step % 10 == 0)
    step /= 10;
  return step == 1 || step == 2 || step == 5;
}

} // namespace

Log::Log(LogLevel level, bool active, std::FILE* stream)
    : level_(level), active_(active), terminal_(isatty(fileno(stream)) != 0), stream_(stream) {}

void Log::write(LogLevel level, const std::string& message) {
  if (!active_ || level < level_)
    return;
  end_progress_line();
  fmt::print(stream_, "{}{}\n", level == LogLevel::warning ? "warning: " : "", message);
  std::fflush(stream_);
}

void Log::progress(long step, const std::string& line, bool force) {
  if (!active_ || level_ > LogLevel::info)
    return;
  if (terminal_) {
    fmt::print(stream_, "\r\033[K{}", line);
    progress_open_ = true;
  } else if (force || (interval_ > 0 ? step % interval_ == 0 : is_sparse_step(step))) {
    fmt::print(stream_, "{}\n", line);
  }
  std::fflush(stream_);
}

void Log::end_progress_line() {
  if (progress_open_)
    fmt::print(stream_, "\n");
  progress_open_ = false;
}

} // namespace trime
