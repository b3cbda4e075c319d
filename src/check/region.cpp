// SPDX-License-Identifier: BSD-3-Clause
#include "region.hpp"

#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace trime_check {
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
        throw Failure(ExitCode::usage, fmt::format("region '{}': no part is called '{}'", text_, name));
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
  leaves_.resize(parts.size());
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
  for (const std::size_t leaf : leaves_[part]) {
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
