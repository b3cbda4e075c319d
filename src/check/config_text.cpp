// SPDX-License-Identifier: BSD-3-Clause
#include "config_text.hpp"

#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace trime_check {
namespace {

constexpr const char* blanks = " \t\r\v\f";

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string without_comment(const std::string& line) {
  for (std::size_t k = 0; k < line.size(); ++k)
    if ((line[k] == ';' || line[k] == '#') && (k == 0 || std::isspace(static_cast<unsigned char>(line[k - 1]))))
      return trimmed(line.substr(0, k));
  return trimmed(line);
}

/// The numbers of a text, as many as there are; Fortran's 1D-3 is one.
std::vector<double> numbers_of(std::string text) {
  for (char& c : text)
    c = c == 'D' || c == 'd' ? 'e' : c == ',' || c == ';' ? ' ' : c;
  std::vector<double> numbers;
  const char* at = text.c_str();
  for (char* end = nullptr;; at = end) {
    const double value = std::strtod(at, &end);
    if (end == at)
      return numbers;
    numbers.push_back(value);
  }
}

} // namespace

ConfigText::ConfigText(const std::string& text, std::string folder) : folder_(std::move(folder)) {
  std::istringstream lines(text);
  std::string section;
  for (std::string line; std::getline(lines, line);) {
    line = without_comment(line);
    if (line.size() > 2 && line.front() == '[' && line.back() == ']') {
      section = trimmed(line.substr(1, line.size() - 2));
      if (section.starts_with("shape."))
        parts_.push_back(section.substr(6));
      else if (section.starts_with("region."))
        regions_.push_back(section.substr(7));
    } else if (const std::size_t sign = line.find('='); sign != std::string::npos)
      values_[{section, trimmed(line.substr(0, sign))}] = trimmed(line.substr(sign + 1));
  }
}

std::string ConfigText::value(const std::string& section, const std::string& key) const {
  const auto found = values_.find({section, key});
  return found == values_.end() || found->second == "auto" || found->second == "none" ? "" : found->second;
}

bool ConfigText::has(const std::string& section, const std::string& key) const {
  const auto found = values_.find({section, key});
  return found != values_.end() && !found->second.empty() && found->second != "none";
}

bool ConfigText::has_section(const std::string& beginning) const {
  const auto found = values_.lower_bound({beginning, ""});
  return found != values_.end() && found->first.first.starts_with(beginning);
}

std::optional<double> ConfigText::number(const std::string& section, const std::string& key) const {
  const std::vector<double> numbers = numbers_of(value(section, key));
  return numbers.empty() ? std::nullopt : std::optional(numbers[0]);
}

Point ConfigText::point(const std::string& section, const std::string& key) const {
  const std::vector<double> numbers = numbers_of(value(section, key));
  if (numbers.size() != 2)
    throw Failure(ExitCode::usage,
                  fmt::format("the config must have two numbers for the key '{}' in [{}]", key, section));
  return {numbers[0], numbers[1]};
}

std::string ConfigText::path(const std::string& section, const std::string& key) const {
  const std::string name = value(section, key);
  return name.empty() || name[0] == '/' || folder_.empty() ? name : folder_ + "/" + name;
}

bool has_region_sizes(const ConfigText& config) {
  return std::ranges::any_of(config.regions(), [&config](const std::string& name) {
    return config.number("region." + name, "size").has_value();
  });
}

std::optional<std::string> read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    return std::nullopt;
  return text.str();
}

std::vector<Ring> read_rings(const std::string& text) {
  std::vector<Ring> rings;
  Ring ring;
  const auto end_ring = [&] {
    if (ring.size() > 1 && ring.front().x == ring.back().x && ring.front().y == ring.back().y)
      ring.pop_back();
    if (!ring.empty())
      rings.push_back(std::move(ring));
    ring.clear();
  };
  std::string all = text + "\n";
  for (char& c : all)
    c = c == '\r' ? '\n' : c; // the code below distinguishes an empty line after CR LF from a blank one
  bool after_return = false;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k] != '\n')
      continue;
    const std::string line = all.substr(begin, k - begin);
    begin = k + 1;
    const bool is_half_of_pair = line.empty() && after_return && text.size() > k && text[k] == '\n';
    after_return = text.size() > k && text[k] == '\r';
    if (is_half_of_pair)
      continue;
    const std::string content = trimmed(line.substr(0, line.find('#')));
    const std::vector<double> numbers = numbers_of(content);
    if (numbers.size() >= 2)
      ring.push_back({numbers[0], numbers[1]});
    else if (trimmed(line).empty() || content.starts_with('>'))
      end_ring();
  }
  end_ring();
  return rings;
}

namespace {

/// Reads a region from left to right.
class RegionReader {
public:
  RegionReader(const std::string& text, const PartNumbers& parts) : text_(text), parts_(parts) {}

  std::vector<Region::Node> read() {
    read_one();
    return std::move(nodes_);
  }

private:
  using Node = Region::Node;

  /// @return the number of its node
  std::size_t read_one() {
    const std::string name = word();
    if (next() != '(') {
      const auto found = parts_.find(name);
      if (found == parts_.end())
        throw Failure(ExitCode::usage,
                      fmt::format("region '{}': the config has no part with the name '{}'", text_, name));
      nodes_.push_back({Region::Kind::part, found->second});
      return nodes_.size() - 1;
    }
    std::vector<std::size_t> children;
    do {
      ++at_;
      children.push_back(read_one());
    } while (next() == ',');
    if (next() != ')')
      throw Failure(ExitCode::usage, fmt::format("region '{}': expected ')' at column {}", text_, at_ + 1));
    ++at_;
    for (const std::size_t child : children) {
      nodes_[child].parent = nodes_.size();
      nodes_[child].is_first = child == children.front();
    }
    Node node;
    node.kind = name == "union"          ? Region::Kind::unite
                : name == "intersection" ? Region::Kind::intersect
                                         : Region::Kind::subtract;
    node.children = children.size();
    nodes_.push_back(node);
    return nodes_.size() - 1;
  }

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
  const PartNumbers& parts_;
  std::vector<Node> nodes_;
  std::size_t at_ = 0;
};

} // namespace

Region::Region(const std::string& text, const PartNumbers& parts) : nodes_(RegionReader(text, parts).read()) {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (nodes_[k].kind == Kind::part)
      leaves_[nodes_[k].part].push_back(k);
}

bool Region::holds(const Node& node) {
  switch (node.kind) {
  case Kind::intersect:
    return node.set == node.children;
  case Kind::subtract:
    return node.first_is_set && node.set == 1;
  default:
    return node.set > 0;
  }
}

void Region::set(std::size_t part, bool inside) {
  const auto leaves = leaves_.find(part);
  if (leaves == leaves_.end())
    return;
  for (const std::size_t leaf : leaves->second) {
    if (holds(nodes_[leaf]) == inside)
      continue;
    nodes_[leaf].set = inside ? 1 : 0;
    bool now = inside;
    for (std::size_t child = leaf, k = nodes_[leaf].parent; k != none; child = k, k = nodes_[k].parent) {
      Node& node = nodes_[k];
      const bool before = holds(node);
      node.set += now ? 1 : -std::size_t{1};
      if (nodes_[child].is_first)
        node.first_is_set = now;
      if (holds(node) == before)
        break;
      now = !before;
    }
  }
}

} // namespace trime_check
