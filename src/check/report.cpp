// SPDX-License-Identifier: BSD-3-Clause
#include "report.hpp"

#include <fmt/format.h>

namespace trime_check {

void Report::add(const std::string& name, bool passed, const std::string& expected, const std::string& found,
                 const std::string& meaning, const std::string& place) {
  ++checks_;
  if (!passed)
    failed_.push_back(name);
  std::string line =
      fmt::format("{:<6} {:<20} expected {}, found {}: {}", passed ? "ok" : "WRONG", name, expected, found, meaning);
  if (!place.empty())
    line += fmt::format("; {}", place);
  lines_.push_back(std::move(line));
}

void Report::none(const std::string& name, const Tally& tally, const std::string& meaning) {
  add(name, tally.count == 0, "0", std::to_string(tally.count), meaning,
      tally.count == 0 ? "" : "first: " + tally.place);
}

void Report::equal(const std::string& name, std::int64_t expected, std::int64_t found, const std::string& meaning,
                   const std::string& place) {
  add(name, expected == found, std::to_string(expected), std::to_string(found), meaning, place);
}

void Report::skip(const std::string& name, const std::string& reason) {
  ++skipped_;
  lines_.push_back(fmt::format("{:<6} {:<20} not checked: {}", "--", name, reason));
}

void Report::info(const std::string& name, const std::string& text) {
  lines_.push_back(fmt::format("{:<6} {:<20} {}", "info", name, text));
}

std::string Report::text() const {
  std::string text;
  for (const std::string& line : lines_)
    text += line + "\n";
  const std::string rest = skipped_ > 0 ? fmt::format("; {} not checked, see above", skipped_) : "";
  if (failed_.empty())
    return text + fmt::format("All {} checks passed{}.\n", checks_, rest);
  text += fmt::format("{} of {} checks FAILED{}:", failed_.size(), checks_, rest);
  for (const std::string& name : failed_)
    text += " " + name;
  return text + "\n";
}

} // namespace trime_check
