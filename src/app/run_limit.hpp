// SPDX-License-Identifier: BSD-3-Clause
// Says in one sentence what limits the speed or the size of a run on its number of ranks.
#pragma once

#include "app/measurements.hpp"

#include <string>

namespace trime::app {

/// The numbers that decide which sentence the report prints.
struct LimitRules {
  /// [1] A cause with a smaller share of time or memory is not mentioned.
  static constexpr double worth_telling = 0.05;
  /// [s] Latency on the network of a cluster: of a message in addition to the time for its bytes, and of a collective
  /// call for each doubling of the ranks. Between hosts with TCP the latency is twenty times as long.
  static constexpr double latency = 2e-6;
  /// [1] The sentence mentions rounds in which ranks fetch ghosts if there are at least this many per sweep. Most
  /// sweeps need no such round.
  static constexpr double many_fetch_rounds = 0.5;
};

/// @brief Returns one sentence about the limit of a run. The sentence names the cause with the largest share of the
/// time that more ranks would not reduce, or of the memory of a rank. With one rank it names the phase that takes
/// longest. The estimate uses counters and the times of phases; it does not measure waiting.
std::string run_limit(const Measurements& measured);

} // namespace trime::app
