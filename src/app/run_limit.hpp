// SPDX-License-Identifier: BSD-3-Clause
// Says in one sentence what keeps a run from being faster on its ranks.
#pragma once

#include "app/measurements.hpp"

#include <string>

namespace trime::app {

/// Numbers that decide which sentence the report prints.
struct LimitRules {
  /// [1] Smaller shares of time or memory are not worth a sentence.
  static constexpr double worth_telling = 0.05;
  /// [s] Latency of a message, in addition to the time for its bytes, and of a collective for each doubling of the
  /// ranks, on the network of a cluster. Between hosts with TCP it is twenty times as long.
  static constexpr double latency = 2e-6;
  /// [1] The sentence names fetch rounds from this number per sweep on: most sweeps need no round.
  static constexpr double many_fetch_rounds = 0.5;
};

/// @brief One sentence on what limits a run: of some causes that with the largest share of the time that more ranks
/// would not win back, or of a rank's memory. On one rank: the phase that takes longest. It is an estimate: of counters
/// and the times of phases, not of waiting.
std::string run_limit(const Measurements& measured);

} // namespace trime::app
