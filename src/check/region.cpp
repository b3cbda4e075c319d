// SPDX-License-Identifier: BSD-3-Clause
// union, intersection and difference of named parts, nested.
#include "curves.hpp"
#include "report.hpp"

#include <algorithm>
#include <functional>

namespace trime_check {
namespace {

/// Reads a region from left to right and joins the values of its parts.
template <class Value>
class RegionReader {
public:
  using Join = std::function<Value(const std::string& operation, const std::vector<Value>&)>;
  RegionReader(const std::string& text, const std::vector<std::pair<std::string, Value>>& parts, Join join)
      : text_(text), parts_(parts), join_(std::move(join)) {}

  Value read() {
    const std::string name = word();
    if (next() != '(') {
      const auto found = std::ranges::find(parts_, name, &std::pair<std::string, Value>::first);
      if (found == parts_.end())
        throw Failure(ExitCode::usage, fmt::format("region '{}': no part is called '{}'", text_, name));
      return found->second;
    }
    std::vector<Value> values;
    do {
      ++at_;
      values.push_back(read());
    } while (next() == ',');
    if (next() != ')')
      throw Failure(ExitCode::usage, fmt::format("region '{}': expected ')' at column {}", text_, at_ + 1));
    ++at_;
    return join_(name, values);
  }

private:
  char next() {
    at_ = std::min(text_.find_first_not_of(" \t", at_), text_.size());
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  std::string word() {
    next();
    const std::size_t end = std::min(text_.find_first_of("(), \t", at_), text_.size());
    const std::string found = text_.substr(at_, end - at_);
    at_ = end;
    return found;
  }

  const std::string& text_;
  const std::vector<std::pair<std::string, Value>>& parts_;
  Join join_;
  std::size_t at_ = 0;
};

} // namespace

bool evaluate_region(const std::string& region, const std::vector<std::pair<std::string, bool>>& inside) {
  const auto join = [](const std::string& operation, const std::vector<bool>& values) {
    const bool any_later = std::any_of(values.begin() + 1, values.end(), [](bool v) { return v; });
    const bool all_later = std::all_of(values.begin() + 1, values.end(), [](bool v) { return v; });
    return operation == "union"          ? values[0] || any_later
           : operation == "intersection" ? values[0] && all_later
                                         : values[0] && !any_later;
  };
  return RegionReader<bool>(region, inside, join).read();
}

Box region_box(const std::string& region, const std::vector<std::pair<std::string, Box>>& boxes) {
  const auto join = [](const std::string& operation, const std::vector<Box>& values) {
    Box box = values[0];
    for (const Box& other : values) {
      if (operation == "union")
        box = {{std::min(box.min.x, other.min.x), std::min(box.min.y, other.min.y)},
               {std::max(box.max.x, other.max.x), std::max(box.max.y, other.max.y)}};
      else if (operation == "intersection")
        box = {{std::max(box.min.x, other.min.x), std::max(box.min.y, other.min.y)},
               {std::min(box.max.x, other.max.x), std::min(box.max.y, other.max.y)}};
    }
    return box;
  };
  return RegionReader<Box>(region, boxes, join).read();
}

} // namespace trime_check
