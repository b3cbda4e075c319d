// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/log.hpp"

#include <cstdlib>
#include <string_view>
#include <unistd.h>

namespace trime {
namespace {

/// 1, 2, 5, 10, 20, 50, ...: enough to follow a batch job, too few to fill its file.
bool is_sparse_step(long step) {
  while (step >= 10 && step % 10 == 0)
    step /= 10;
  return step == 1 || step == 2 || step == 5;
}

/// Does a person watch? Under mpirun every process writes to a pseudo-terminal of its launcher, so there the launcher's
/// own output is asked; a launcher on another node, which cannot be asked, counts as no terminal.
bool is_watched(std::FILE* stream) {
  if (isatty(fileno(stream)) == 0)
    return false;
  if (std::getenv("OMPI_COMM_WORLD_RANK") == nullptr)
    return true;
  char target[64] = "";
  if (readlink(fmt::format("/proc/{}/fd/1", getppid()).c_str(), target, sizeof target - 1) < 0)
    return false;
  return std::string_view(target).starts_with("/dev/pts/") || std::string_view(target).starts_with("/dev/tty");
}

} // namespace

Log::Log(LogLevel level, bool active, std::FILE* stream)
    : level_(level), active_(active), terminal_(active && is_watched(stream)), stream_(stream) {}

void Log::write(LogLevel level, const std::string& message) {
  if (!active_ || level < level_)
    return;
  end_progress_line();
  fmt::print(stream_, "{}{}\n", level == LogLevel::warning ? "warning: " : "", rewrite_ ? rewrite_(message) : message);
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
