// SPDX-License-Identifier: BSD-3-Clause
#include "trime/shape/region_shape.hpp"

#include "core/quoted.hpp"
#include "shape/make_boundary.hpp"
#include "shape/part_images.hpp"
#include "trime/core/error.hpp"
#include "trime/shape/traced_part.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <unordered_map>
#include <unordered_set>

namespace trime::shape {
namespace {

const std::vector<std::string> operation_names{"union", "intersection", "difference"};

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

std::string unknown_part_message(const std::string& name, std::span<const std::string> part_names) {
  std::vector<std::string> known(part_names.begin(), part_names.end());
  known.emplace_back(domain_name);
  return fmt::format("unknown part {} in the geometry; known parts: {}{}", quoted(name), fmt::join(known, ", "),
                     suggestion(name, known));
}

} // namespace

/// Recursive descent, at most max_depth deep.
class Region::Parser {
public:
  Parser(Region& region, std::span<const std::string> names) : region_(region), names_(names), text_(region.text_) {
    for (std::size_t k = 0; k < names.size(); ++k)
      index_of_.emplace(names[k], static_cast<int>(k));
  }

  void parse() {
    expression(0);
    skip_blanks();
    if (position_ < text_.size())
      fail("expected the end", "; write 'union(a, b)' to join two parts");
  }

private:
  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const {
    const std::string found = position_ < text_.size() ? fmt::format("'{}'", text_.substr(position_, 20)) : "the end";
    throw ConfigError(
        fmt::format("geometry, column {}: {}, found {} in '{}'{}", position_ + 1, what, found, text_, hint));
  }

  void skip_blanks() {
    while (position_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[position_])) != 0)
      ++position_;
  }

  bool take(char c) {
    skip_blanks();
    if (position_ >= text_.size() || text_[position_] != c)
      return false;
    ++position_;
    return true;
  }

  std::string name() {
    skip_blanks();
    const std::size_t start = position_;
    while (position_ < text_.size() && is_name_character(text_[position_]))
      ++position_;
    if (position_ == start)
      fail("expected the name of a part, or union(...), intersection(...), difference(...)");
    return std::string(text_.substr(start, position_ - start));
  }

  int expression(int depth) {
    if (depth > max_depth)
      fail(fmt::format("expected at most {} nested operations", max_depth));
    const std::string word = name();
    const int node = static_cast<int>(region_.nodes_.size());
    region_.nodes_.push_back({Operation::part, -1, {}});
    if (take('('))
      operation(node, word, depth);
    else
      region_.nodes_[node].part = part_index(word);
    return node;
  }

  void operation(int node, const std::string& word, int depth) {
    if (word != "union" && word != "intersection" && word != "difference")
      throw ConfigError(fmt::format("geometry: expected union(...), intersection(...) or difference(...) instead of "
                                    "'{}(...)' in '{}'{}",
                                    word, text_, suggestion(word, operation_names)));
    std::vector<int> operands;
    do
      operands.push_back(expression(depth + 1));
    while (take(','));
    if (!take(')'))
      fail("expected ',' or ')'");
    if (operands.size() < 2)
      fail(fmt::format("expected {}(...) of two or more parts", word));
    region_.nodes_[node].operation = word == "union"          ? Operation::unite
                                     : word == "intersection" ? Operation::intersect
                                                              : Operation::subtract;
    region_.nodes_[node].operands = std::move(operands);
  }

  int part_index(const std::string& word) {
    int index = 0;
    if (word == domain_name)
      index = static_cast<int>(names_.size());
    else {
      const auto found = index_of_.find(word);
      if (found == index_of_.end())
        throw ConfigError(unknown_part_message(word, names_));
      index = found->second;
    }
    region_.parts_.push_back(index);
    return index;
  }

  Region& region_;
  std::span<const std::string> names_;
  std::unordered_map<std::string, int> index_of_; // of each name
  std::string_view text_;
  std::size_t position_ = 0;
};

Region Region::parse(std::string_view text, std::span<const std::string> part_names) {
  Region region;
  region.text_ = text;
  Parser(region, part_names).parse();
  std::sort(region.parts_.begin(), region.parts_.end());
  region.parts_.erase(std::unique(region.parts_.begin(), region.parts_.end()), region.parts_.end());
  return region;
}

Region Region::of_part(int part, std::string_view text) {
  Region region;
  region.text_ = text;
  region.nodes_ = {{Operation::part, part, {}}};
  region.parts_ = {part};
  return region;
}

bool Region::subtracts(int node, int part, bool even) const {
  const Node& n = nodes_[static_cast<std::size_t>(node)];
  if (n.operation == Operation::part)
    return even && n.part == part;
  for (std::size_t k = 0; k < n.operands.size(); ++k)
    if (subtracts(n.operands[k], part, (n.operation == Operation::subtract && k > 0) != even))
      return true;
  return false;
}

geometry::Box Region::box_of(std::size_t node, std::span<const geometry::Box> boxes) const {
  const Node& n = nodes_[node];
  if (n.operation == Operation::part)
    return boxes[static_cast<std::size_t>(n.part)];
  geometry::Box box = box_of(static_cast<std::size_t>(n.operands[0]), boxes);
  for (std::size_t k = 1; k < n.operands.size() && n.operation != Operation::subtract; ++k) {
    const geometry::Box other = box_of(static_cast<std::size_t>(n.operands[k]), boxes);
    box = n.operation == Operation::unite ? geometry::united(box, other) : geometry::intersected(box, other);
  }
  return box;
}

namespace {

using geometry::Frame;
using geometry::Vec2;

std::vector<std::string> names_of(const std::vector<Part>& parts) {
  std::vector<std::string> names;
  std::unordered_set<std::string> known;
  for (const Part& part : parts) {
    if (part.name() == domain_name)
      throw ConfigError(fmt::format("a part must not be named '{}': this name means the container", domain_name));
    if (!known.insert(part.name()).second)
      throw ConfigError(fmt::format("two parts are named '{}'; expected different names", part.name()));
    names.push_back(part.name());
  }
  return names;
}

} // namespace

RegionShape::RegionShape(std::vector<Part> parts, std::string_view region, const Frame& frame, const InnerParts& inner)
    : parts_(std::move(parts)), region_(Region::parse(region, names_of(parts_))),
      domain_(make_boundary(region_, parts_, frame, inner)), tree_(domain_.boundary()) {
  parts_.push_back(domain_part(frame));
  shifts_.resize(parts_.size());
  for (const int part : region_.parts())
    shifts_[part] = image_shifts(parts_[part], frame);
}

bool RegionShape::inside(Vec2 p) const {
  const Vec2 canonical = frame().periods().wrap(p);
  return region_.contains([&](int part) {
    for (const Vec2 shift : shifts_[part])
      if (parts_[part].inside(canonical - shift))
        return true;
    return false;
  });
}

geometry::Domain domain_of(std::vector<Part> parts, std::string_view region, const Frame& frame,
                           const InnerParts& inner) {
  return make_boundary(Region::parse(region, names_of(parts)), std::move(parts), frame, inner);
}

RegionShape traced(const tracing::Shape& shape, const Frame& frame, const std::string& name) {
  return RegionShape({traced_part(name, shape, frame)}, name, frame);
}

} // namespace trime::shape
