// SPDX-License-Identifier: BSD-3-Clause
#include "record/acceptance_record.hpp"

#include "record/groups.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace trime::record {
namespace {

using polygon::LoopSummary;

/// Counts the outer loops, and those whose parts are all open.
acceptance::BoundaryFacts facts_of(const AcceptanceInput& input, const meshing::MeshResult& result) {
  acceptance::BoundaryFacts facts{input.periods, result.components, 0, 0, input.open_parts};
  const auto is_open = [&](std::int32_t part) {
    const auto k = static_cast<std::size_t>(part);
    return k < input.open_parts.size() && input.open_parts[k];
  };
  for (const LoopSummary& loop : result.loops)
    if (loop.kind == LoopSummary::Kind::outer) {
      ++facts.outer_loops;
      facts.open_outer_loops += std::ranges::all_of(loop.parts, is_open);
    }
  return facts;
}

mesh::Check check_of(const acceptance::Verdict& verdict) {
  const acceptance::SolverRule& rule = verdict.rule;
  return {check_name(rule), 0, static_cast<double>(verdict.broken), verdict.holds(),
          fmt::format("{} that {} refuses: {} {:g} is allowed", rule.breakers, acceptance::word_of(rule.solver),
                      rule.is_least ? "at least" : "at most", rule.limit)};
}

} // namespace

std::string check_name(const acceptance::SolverRule& rule) {
  return fmt::format("{}_{}", acceptance::word_of(rule.solver), acceptance::name_of(rule.measure));
}

std::vector<acceptance::Verdict> judge_mesh(const AcceptanceInput& input, meshing::MeshResult& result,
                                            const comm::Communicator& comm) {
  std::vector<acceptance::Verdict> verdicts =
      acceptance::judge(result.mesh, input.solvers, facts_of(input, result), comm);
  for (const acceptance::Verdict& verdict : verdicts)
    if (verdict.rule.refuses)
      result.checks.push_back(check_of(verdict));
  return verdicts;
}

void print_verdicts(const std::vector<acceptance::Verdict>& verdicts, bool splits_ears, Log& log) {
  for (std::size_t first = 0, end = 0; first < verdicts.size(); first = end) {
    const acceptance::Solver solver = verdicts[first].rule.solver;
    const auto is_other = [&](const acceptance::Verdict& verdict) { return verdict.rule.solver != solver; };
    const auto next = std::find_if(verdicts.begin() + static_cast<std::ptrdiff_t>(first), verdicts.end(), is_other);
    end = static_cast<std::size_t>(next - verdicts.begin());
    const auto held = std::count_if(verdicts.begin() + static_cast<std::ptrdiff_t>(first), next,
                                    [](const acceptance::Verdict& verdict) { return verdict.holds(); });
    log.summary("accept {}: {} of {} rules hold", acceptance::word_of(solver), held, end - first);
    for (std::size_t k = first; k < end; ++k)
      if (!verdicts[k].holds())
        log.warning("{}", acceptance::text_of(verdicts[k], splits_ears));
  }
}

io::MetadataGroup accept_group(const std::vector<acceptance::Verdict>& verdicts) {
  using Judged = acceptance::Verdict;
  return {"accept",
          {},
          {column<std::string>("solver", verdicts,
                               [](const Judged& v) { return std::string(acceptance::word_of(v.rule.solver)); }),
           column<std::string>("rule", verdicts,
                               [](const Judged& v) { return std::string(acceptance::name_of(v.rule.measure)); }),
           column<std::int32_t>("is_least", verdicts, [](const Judged& v) { return v.rule.is_least; }),
           column<double>("limit", verdicts, [](const Judged& v) { return v.rule.limit; }),
           column<double>("worst", verdicts, &Judged::worst), column<std::int64_t>("broken", verdicts, &Judged::broken),
           column<std::int64_t>("measured", verdicts, &Judged::measured),
           column<std::int32_t>("refuses", verdicts, [](const Judged& v) { return v.rule.refuses; }),
           column<double>("x", verdicts, [](const Judged& v) { return v.place.x; }),
           column<double>("y", verdicts, [](const Judged& v) { return v.place.y; })}};
}

std::vector<Verdict> verdicts_of(const io::Metadata& metadata) {
  const char* table = "accept";
  std::vector<Verdict> verdicts;
  if (io::find_group(metadata, table) == nullptr)
    return verdicts;
  const auto& solvers = io::column_of<std::string>(metadata, table, "solver");
  const auto& rules = io::column_of<std::string>(metadata, table, "rule");
  const auto& is_least = io::column_of<std::int32_t>(metadata, table, "is_least");
  const auto& refuses = io::column_of<std::int32_t>(metadata, table, "refuses");
  const auto& limits = io::column_of<double>(metadata, table, "limit");
  const auto& worst = io::column_of<double>(metadata, table, "worst");
  const auto& broken = io::column_of<std::int64_t>(metadata, table, "broken");
  const auto& measured = io::column_of<std::int64_t>(metadata, table, "measured");
  const auto &x = io::column_of<double>(metadata, table, "x"), &y = io::column_of<double>(metadata, table, "y");
  for (std::size_t k = 0; k < solvers.size(); ++k) {
    verdicts.push_back({solvers[k], rules.at(k), is_least.at(k) != 0, limits.at(k), worst.at(k), broken.at(k),
                        measured.at(k), refuses.at(k) != 0, std::nullopt});
    if (std::isfinite(x.at(k)) && std::isfinite(y.at(k)))
      verdicts.back().place = geometry::Vec2{x[k], y[k]};
  }
  return verdicts;
}

} // namespace trime::record
