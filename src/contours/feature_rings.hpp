// SPDX-License-Identifier: BSD-3-Clause
// Rings out of the features of maps: polygons, lines that are closed or together close rings, and an attribute of the
// features as markers and names.
#pragma once

#include "contours/ring_builder.hpp"

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace trime::contours {

/// Collects the rings of the features of a map. Knows neither JSON nor shapefiles.
class FeatureRings {
public:
  enum class Kind { polygon, line };

  /// @param contour with its source; gets rings, names and warnings, and outlives this object
  /// @param attribute that names the boundary; empty: none
  FeatureRings(Contour& contour, std::string attribute);

  /// @brief A ring, or a line that may be open, of the present feature. @pre not empty
  void add(Kind kind, std::vector<FilePoint> vertices);
  /// A geometry that bounds nothing, and the name of its type.
  void skip(const std::string& type, int line);
  /// An attribute that some feature has, whatever its value.
  void has_attribute(const std::string& name);
  /// @brief Ends the present feature.
  /// @param value of its attribute; none: it has none
  /// @param label for messages, behind the line, such as " (feature 3)"
  /// @throws GeometryError for coordinates that are too large, or a ring with fewer than three distinct vertices
  void end_feature(const std::optional<std::string>& value = {}, const std::string& label = {});
  /// @brief Joins open lines and gives the rings their markers.
  /// @param expected what the file should have held, for the message if it holds no vertex
  /// @throws GeometryError also for lines that stay open; ConfigError if no feature has the attribute
  void finish(const char* expected);

private:
  struct Chain {
    Kind kind;
    std::vector<FilePoint> vertices;
    std::string label = {}; // of an open line
  };

  int number_of(const std::optional<std::string>& value);
  void check_ends() const;
  void join_lines();
  void resolve_markers();
  void tell_skipped();

  Contour& contour_;
  RingBuilder builder_;
  std::string attribute_;
  std::vector<Chain> of_feature_;
  std::vector<Chain> open_lines_;
  std::vector<int> open_markers_;      // of each open line
  std::map<std::string, int> numbers_; // of the values of the attribute, from 1
  std::vector<std::string> values_;    // by number - 1
  std::set<std::string> attributes_;
  int skipped_ = 0, skipped_line_ = 0;
  std::string skipped_type_;
};

} // namespace trime::contours
