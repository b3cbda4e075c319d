// SPDX-License-Identifier: BSD-3-Clause
#include "app/run_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace trime::app {
namespace {

struct Cause {
  double share; ///< of time or memory
  std::string text;
};

double percent(double share) {
  return 100 * share;
}

/// Time that the ranks wait for the one with most of something, if it is the work of a phase.
double waiting(const Measurements& m, const std::string& phase, Counter work) {
  return m.share(phase) * (1 - 1 / m.imbalance(work));
}

Cause imbalance(const Measurements& m) {
  const double densest =
      static_cast<double>(m.counters[Counter::densest_tile].max) / std::max(1.0, m.mean(Counter::points));
  return {waiting(m, "sweeps", Counter::sites_swept),
          fmt::format("imbalance {:.2f}: one rank sweeps this many times as many points as the mean; the densest tile "
                      "holds {:.0f} % of a rank's points",
                      m.imbalance(Counter::sites_swept), percent(densest))};
}

Cause set_up(const Measurements& m) {
  constexpr std::array phases{"shape", "size field", "boundary", "start"};
  double share = 0;
  for (const char* phase : phases)
    share += m.share(phase);
  return {share * (1 - 1.0 / m.ranks), fmt::format("set-up: {:.0f} % of the time goes to shape, size field, boundary "
                                                   "and start, and most of this work is repeated on each rank",
                                                   percent(share))};
}

Cause output(const Measurements& m) {
  return {m.share("output") * (1 - 1.0 / m.ranks),
          fmt::format("output: {:.0f} % of the time goes to writing the files", percent(m.share("output")))};
}

Cause clean_up(const Measurements& m) {
  return {waiting(m, "clean-up", Counter::patches),
          fmt::format("clean-up: {:.0f} % of the time goes to {} rounds; one rank tries {:.1f} times as many patches "
                      "as the mean",
                      percent(m.share("clean-up")), m.counters[Counter::cleanup_rounds].max,
                      m.imbalance(Counter::patches))};
}

Cause latency(const Measurements& m) {
  const auto collectives = static_cast<double>(m.counters[Counter::collectives].max);
  const double seconds = LimitRules::latency * (static_cast<double>(m.counters[Counter::messages].max) +
                                                collectives * std::ceil(std::log2(m.ranks)));
  const double passes = std::max(1.0, m.mean(Counter::passes));
  const double fetches = m.mean(Counter::fetch_rounds) / passes;
  return {seconds / std::max(m.total, LimitRules::latency),
          fmt::format("latency: each sweep needs {:.1f} collectives and {:.1f} messages for only a few sites{}",
                      collectives / passes, m.mean(Counter::messages) / passes,
                      fetches >= LimitRules::many_fetch_rounds
                          ? fmt::format("; the halo is fetched {:.1f} times a sweep", fetches)
                          : "")};
}

Cause replicated(const Measurements& m) {
  std::int64_t bytes = 0;
  for (const Counter table : {Counter::grid_bytes, Counter::boundary_bytes, Counter::size_bytes, Counter::rank_bytes})
    bytes += m.counters[table].max;
  const double share = static_cast<double>(bytes) / static_cast<double>(std::max<std::int64_t>(m.peak_memory, 1));
  return {
      share,
      fmt::format(
          "memory: tables that every rank holds completely take {:.1f} MiB, {:.0f} % of the largest memory of a rank",
          static_cast<double>(bytes) / 0x1p20, percent(share))};
}

std::string longest_phase(const Measurements& m) {
  const auto longest = std::ranges::max_element(m.phases, {}, &Phase::mean);
  return longest == m.phases.end()
             ? "nothing was measured"
             : fmt::format("one rank: {:.0f} % of the time goes to {}", percent(m.share(longest->name)), longest->name);
}

} // namespace

std::string run_limit(const Measurements& m) {
  if (m.ranks == 1)
    return longest_phase(m);
  const std::vector<Cause> causes{imbalance(m), set_up(m), output(m), clean_up(m), latency(m), replicated(m)};
  const Cause& first = *std::ranges::max_element(causes, {}, &Cause::share);
  return first.share >= LimitRules::worth_telling
             ? first.text
             : fmt::format("no measured cause takes more than {:.0f} % of the time",
                           percent(LimitRules::worth_telling));
}

} // namespace trime::app
