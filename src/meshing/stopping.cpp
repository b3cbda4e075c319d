// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/stopping.hpp"

namespace trime::meshing {
namespace {

constexpr double still = 0.005; // of h
constexpr int window = 5, earliest = 10;

} // namespace

std::optional<StopReason> StopRule::decide(const std::vector<SweepRecord>& history) const {
  const int n = static_cast<int>(history.size());
  const SweepRecord& last = history.back();
  if (n > 1 && last.max_move < still)
    return StopReason::converged;
  if (n >= earliest) {
    const double before = history[static_cast<std::size_t>(n - 1 - window)].mean_alpha - 1;
    if (last.mean_alpha - 1 >= (1 - tolerance_) * before)
      return StopReason::quality_stalled;
  }
  if (n > max_sweeps_)
    return StopReason::sweep_cap;
  return std::nullopt;
}

std::string to_string(StopReason reason) {
  switch (reason) {
  case StopReason::converged:
    return "converged";
  case StopReason::quality_stalled:
    return "quality stalled";
  case StopReason::sweep_cap:
    return "sweep cap";
  }
  return "unknown";
}

} // namespace trime::meshing
