// SPDX-License-Identifier: BSD-3-Clause
#include "contours/feature_rings.hpp"

#include "contours/contour_text.hpp"
#include "contours/faults.hpp"
#include "contours/map_features.hpp"
#include "contours/open_lines.hpp"
#include "contours/segment_rings.hpp"
#include "trime/core/error.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace trime::contours {
namespace {

using geometry::Vec2;

constexpr std::size_t most_attributes = 20; // that are remembered, for a message

/// The whole text as a number that a marker can be.
std::optional<int> integer_of(const std::string& text) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end)
    return {};
  return value;
}

/// Without blanks around it; control characters, which end lines in many formats, are blanks.
std::string cleaned(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }, ' ');
  return std::string(trimmed(text));
}

} // namespace

FeatureRings::FeatureRings(Contour& contour, std::string attribute, Use use)
    : contour_(contour), builder_(contour), attribute_(std::move(attribute)), use_(use) {
  contour_.is_map = true;
}

void FeatureRings::add(Kind kind, std::vector<FilePoint> vertices, bool continues) {
  if (kind == Kind::polygon && !continues)
    ++polygon_;
  of_feature_.push_back({kind, std::move(vertices), kind == Kind::polygon ? polygon_ : 0});
}

void FeatureRings::skip(const std::string& type, int line) {
  if (++skipped_ > 1)
    return;
  skipped_line_ = line;
  skipped_type_ = type;
}

void FeatureRings::has_attribute(const std::string& name) {
  if (attributes_.size() < most_attributes || name == attribute_)
    attributes_.insert(name);
}

/// Contour::features gets an entry for each feature, also for those without rings.
void FeatureRings::note_feature(const FeatureName& feature) {
  if (feature.number == 0)
    return;
  contour_.features.resize(static_cast<std::size_t>(feature.number));
  contour_.features.back() = {of_feature_.front().vertices.front().line, cleaned(feature.name)};
}

void FeatureRings::end_feature(const std::optional<std::string>& value, const FeatureName& feature) {
  if (of_feature_.empty())
    return;
  const int number = number_of(value);
  const std::string label = in_brackets(feature.number, cleaned(feature.name));
  note_feature(feature);
  builder_.set_feature(label);
  for (Chain& chain : of_feature_) {
    for (const FilePoint& vertex : chain.vertices) // before ends are compared
      check_coordinates(vertex.position, contour_.source, vertex.line > 1 ? vertex.line : 0, label);
    if (use_ == Use::curves) {
      add_line(contour_, chain.vertices, number);
      if (feature.number > 0)
        std::fill(contour_.rings.back().lines.begin(), contour_.rings.back().lines.end(), feature.number);
      continue;
    }
    if (chain.kind == Kind::line && chain.vertices.front().position != chain.vertices.back().position) {
      keep_open({std::move(chain.vertices), feature.number, number, label});
      continue;
    }
    builder_.set_polygon(chain.polygon);
    for (const FilePoint& vertex : chain.vertices)
      builder_.add(vertex.position, vertex.line, number);
    const std::size_t rings = contour_.rings.size();
    builder_.end_ring();
    if (feature.number > 0 && contour_.rings.size() > rings) // else the ring was a fault
      std::fill(contour_.rings.back().lines.begin(), contour_.rings.back().lines.end(), feature.number);
  }
  of_feature_.clear();
  builder_.set_polygon(0);
  builder_.set_feature({});
}

/// Keeps a line without vertices that repeat the one before.
void FeatureRings::keep_open(OpenLine line) {
  const auto end = std::unique(line.vertices.begin(), line.vertices.end(), [this](const auto& a, const auto& b) {
    if (a.position == b.position)
      builder_.tell_merged(b.position, b.line);
    return a.position == b.position;
  });
  line.vertices.erase(end, line.vertices.end());
  open_lines_.push_back(std::move(line));
}

void FeatureRings::finish(const char* expected, Faults faults) {
  end_feature();
  if (!attribute_.empty() && attributes_.count(attribute_) == 0)
    throw ConfigError(fmt::format("{}: expected features with the attribute '{}', found {}", contour_.source,
                                  attribute_,
                                  attributes_.empty() ? std::string("none with attributes")
                                                      : fmt::format("only {}", fmt::join(attributes_, ", "))));
  drop_repeated_lines(open_lines_, contour_);
  join_ends_at_date_line(open_lines_, contour_);
  leave_out_open();
  join_lines();
  builder_.finish();
  resolve_markers();
  tell_skipped();
  if (use_ == Use::curves)
    expected = "a map with lines or polygons";
  if (contour_.rings.empty() && contour_.faults.empty() && skipped_ > 0)
    throw GeometryError(
        fmt::format("{}: expected {}, found only geometries of type {} or the like; export the polygons "
                    "or the lines of the map",
                    contour_.source, expected, skipped_type_));
  check_reading(contour_, faults, expected);
}

int FeatureRings::number_of(const std::optional<std::string>& value) {
  const std::string text = value ? cleaned(*value) : std::string();
  if (text.empty())
    return 0;
  const auto [at, is_new] = numbers_.try_emplace(text, static_cast<int>(values_.size()) + 1);
  if (is_new)
    values_.push_back(text);
  return at->second;
}

/// Takes lines that do not close a ring out of open_lines_; they become faults.
void FeatureRings::leave_out_open() {
  std::vector<LineEnds> ends;
  for (const OpenLine& chain : open_lines_) {
    LineEnds& line = ends.emplace_back();
    line.first = chain.vertices.front();
    line.last = chain.vertices.back();
    for (const FilePoint& vertex : chain.vertices)
      line.box.include(vertex.position);
  }
  const std::vector<OpenGroup> groups = open_groups(ends);
  std::vector<char> is_left_out(open_lines_.size(), 0);
  for (const OpenGroup& group : groups) {
    add_fault(contour_.faults, group.nearly_closed || group.branches ? HasArea::yes : HasArea::no,
              [&] { return fault_of(group, place_of_line(contour_, group.end.line, open_lines_[group.line].label)); });
    for (const std::size_t line : group.left_out)
      is_left_out[line] = 1;
  }
  std::size_t kept = 0;
  for (std::size_t line = 0; line < open_lines_.size(); ++line)
    if (is_left_out[line] == 0) {
      if (kept != line)
        open_lines_[kept] = std::move(open_lines_[line]);
      ++kept;
    }
  open_lines_.resize(kept);
}

void FeatureRings::join_lines() {
  for (const auto& ring : rings_of_lines(open_lines_, contour_)) {
    for (const RingVertex& vertex : ring)
      builder_.add(vertex.position, vertex.line, vertex.marker);
    builder_.end_ring();
  }
}

/// Where all values are integers these are the markers; else the values are their names.
void FeatureRings::resolve_markers() {
  const auto is_integer = [](const std::string& value) { return integer_of(value).has_value(); };
  if (!std::all_of(values_.begin(), values_.end(), is_integer)) {
    contour_.marker_names = values_;
    return;
  }
  for (ContourRing& ring : contour_.rings) {
    for (int& marker : ring.markers)
      marker = marker == 0 ? 0 : *integer_of(values_[static_cast<std::size_t>(marker - 1)]);
    if (std::all_of(ring.markers.begin(), ring.markers.end(), [](int marker) { return marker == 0; }))
      ring.markers.clear();
  }
}

void FeatureRings::tell_skipped() {
  if (skipped_ > 0)
    contour_.warnings.push_back(fmt::format("{}: {} geometr{} of type {} or the like left out: only {}",
                                            place_of_line(contour_, skipped_line_), skipped_,
                                            skipped_ == 1 ? "y" : "ies", skipped_type_,
                                            use_ == Use::curves ? "lines and the borders of polygons are curves"
                                                                : "polygons and lines that close rings bound a shape"));
}

} // namespace trime::contours
