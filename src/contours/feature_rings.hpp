// SPDX-License-Identifier: BSD-3-Clause
// Makes rings from the features of maps: from polygons, and from lines that are closed or together form rings. An
// attribute of the features gives markers and names.
#pragma once

#include "contours/segment_rings.hpp"

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace trime::contours {

/// Collects the rings of the features of a map, regardless of the file format.
class FeatureRings {
public:
  enum class Kind { polygon, line };

  /// @param contour names its source; receives rings, names and warnings, and outlives this object
  /// @param attribute the attribute that names the boundary; may be empty
  FeatureRings(Contour& contour, std::string attribute);

  /// @brief Adds a ring, or a line that may be open, to the current feature. @pre it has a vertex
  void add(Kind kind, std::vector<FilePoint> vertices);
  /// Records a geometry that bounds nothing, for a warning with its type.
  void skip(const std::string& type, int line);
  /// Records the name of an attribute that some feature has, whatever its value.
  void has_attribute(const std::string& name);
  /// @brief Ends the current feature.
  /// @param value the value of the attribute, if the feature has it
  /// @param label for messages, behind the line, such as " (feature 3)"
  /// @throws GeometryError for coordinates that are too large, or a ring with fewer than three distinct vertices
  void end_feature(const std::optional<std::string>& value = {}, const std::string& label = {});
  /// @brief Joins open lines and gives the rings their markers.
  /// @param expected what the file should contain, for the message if it has no vertex
  /// @throws GeometryError also if lines stay open; ConfigError if no feature has the attribute
  void finish(const char* expected);

private:
  struct Chain {
    Kind kind;
    std::vector<FilePoint> vertices;
    std::string label = {}; // label of an open line, for messages
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
  std::vector<int> open_markers_;      // marker of each open line
  std::map<std::string, int> numbers_; // numbers of the values of the attribute, from 1
  std::vector<std::string> values_;    // values by number - 1
  std::set<std::string> attributes_;
  int skipped_ = 0, skipped_line_ = 0;
  std::string skipped_type_;
};

} // namespace trime::contours
