// SPDX-License-Identifier: BSD-3-Clause
#include "app/option_value.hpp"

#include "app/option_table.hpp"
#include "core/quoted.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace trime::app {
namespace {

std::string bounds(const Range& range) {
  const bool low = std::isfinite(range.low), high = std::isfinite(range.high);
  if (low && high && range.low_excluded)
    return fmt::format(" > {} and <= {}", range.low, range.high);
  if (low && high)
    return fmt::format(" from {} to {}", range.low, range.high);
  return low ? fmt::format(" {} {}", range.low_excluded ? ">" : ">=", range.low) : "";
}

bool in_range(const Range& range, double value) {
  return (range.low_excluded ? value > range.low : value >= range.low) && value <= range.high;
}

bool is_one_of(std::string_view value, const char* words) {
  const std::vector<std::string> list = split_words(words);
  return std::find(list.begin(), list.end(), value) != list.end();
}

bool is_well_formed(const Option& option, const std::string& value) {
  switch (option.kind) {
  case OptionKind::number: {
    const std::optional<double> number = parse_number(value);
    return is_one_of(value, option.choices) || (number && in_range(option.range, *number));
  }
  case OptionKind::integer: {
    const std::optional<std::int64_t> number = parse_integer(value);
    return is_one_of(value, option.choices) || (number && in_range(option.range, static_cast<double>(*number)));
  }
  case OptionKind::boolean:
    return parse_boolean(value).has_value();
  case OptionKind::word:
    return is_one_of(value, option.choices);
  case OptionKind::words: {
    const std::vector<std::string> words = split_list(value);
    const bool has_none = std::ranges::find(words, "none") != words.end();
    return !words.empty() && !(has_none && words.size() > 1) &&
           std::all_of(words.begin(), words.end(),
                       [&](const std::string& word) { return is_one_of(word, option.choices); });
  }
  case OptionKind::pair:
    return parse_pair(value).has_value();
  case OptionKind::text:
  case OptionKind::path:
    return true;
  }
  return false;
}

/// The nearest allowed word to each word that is not allowed.
std::string word_suggestion(const Option& option, const std::string& value) {
  for (const std::string& word : option.kind == OptionKind::words ? split_list(value) : split_words(value))
    if (!is_one_of(word, option.choices) && !parse_number(word))
      return suggestion(word, split_words(option.choices));
  return "";
}

} // namespace

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-"))
    text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  const std::optional<double> value = parse_number(text);
  if (!value || std::fabs(*value) > 0x1p53 || *value != std::floor(*value))
    return std::nullopt;
  return static_cast<std::int64_t>(*value);
}

std::optional<bool> parse_boolean(std::string_view text) {
  if (text != "true" && text != "false")
    return std::nullopt;
  return text == "true";
}

std::optional<geometry::Vec2> parse_pair(std::string_view text) {
  const std::vector<std::string> words = split_words(text);
  if (words.size() != 2)
    return std::nullopt;
  const std::optional<double> x = parse_number(words[0]), y = parse_number(words[1]);
  if (!x || !y)
    return std::nullopt;
  return geometry::Vec2{*x, *y};
}

std::string expectation(const Option& option) {
  const std::vector<std::string> choices = split_words(option.choices);
  switch (option.kind) {
  case OptionKind::number:
  case OptionKind::integer: {
    const std::string number = (option.kind == OptionKind::number ? "a number" : "an integer") + bounds(option.range);
    return choices.empty() ? number : fmt::format("{} or {}", fmt::join(choices, " or "), number);
  }
  case OptionKind::boolean:
    return "true or false";
  case OptionKind::word:
    return fmt::format("one of {}", fmt::join(choices, ", "));
  case OptionKind::words: {
    const bool has_none = !choices.empty() && choices[0] == "none";
    return fmt::format("{}a list of {}, separated by blanks or commas", has_none ? "none, or " : "",
                       fmt::join(choices.begin() + (has_none ? 1 : 0), choices.end(), ", "));
  }
  case OptionKind::pair:
    return "two numbers X Y separated by a blank";
  case OptionKind::text:
    return "a text";
  case OptionKind::path:
    return "a path";
  }
  return "";
}

std::string value_problem(const Option& option, std::string_view section, const std::string& value) {
  if (is_well_formed(option, value))
    return "";
  return fmt::format("'{} = {}' in [{}]: expected {}{}", option.key, shown(value), shown(section), expectation(option),
                     word_suggestion(option, value));
}

std::string help_config() {
  std::string text = "| key | values (default) | meaning |\n|---|---|---|\n";
  for (const Option& option : option_table()) {
    const std::string fallback = *option.fallback ? fmt::format(" ({})", option.fallback) : "";
    const std::string type = *option.part_type ? fmt::format(" ({})", option.part_type) : "";
    text += fmt::format("| `[{}] {}`{} | {}{} | {} |\n", option.section, option.key, type, expectation(option),
                        fallback, option.meaning);
  }
  return text;
}

} // namespace trime::app
