// SPDX-License-Identifier: BSD-3-Clause
// Makes rings from the features of a map: from polygons, and from lines that are closed or form rings together. An
// attribute of the features gives the markers of the rings and their names.
#pragma once

#include "contours/joined_lines.hpp"
#include "contours/segment_rings.hpp"

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace trime::contours {

/// A feature of a map, as its file numbers and names it.
struct FeatureName {
  int number = 0; ///< from 1; 0 for a geometry that is not in a feature
  std::string name = {};
};

/// Collects the rings of the features of a map, for all file formats.
class FeatureRings {
public:
  enum class Kind { polygon, line };
  /// Says whether the features bound a shape (rings), or are curves inside one. The border of a polygon can be either.
  enum class Use { rings, curves };

  /// @param contour its member `source` must be set; receives rings, names and warnings, and must outlive this object
  /// @param attribute the attribute that names the boundary; may be empty
  FeatureRings(Contour& contour, std::string attribute, Use use = Use::rings);

  /// @brief Adds a ring, or a line that may be open, to the current feature.
  /// @param continues true if the ring belongs to the same polygon as the ring before it
  /// @pre the line has a vertex
  void add(Kind kind, std::vector<FilePoint> vertices, bool continues = false);
  /// Notes a geometry without area or length, such as a point, for a warning with its type.
  void skip(const std::string& type, int line);
  /// Notes the name of an attribute that some feature has.
  void has_attribute(const std::string& name);
  /// @brief Ends the current feature, whose rings and lines get the marker of the value.
  /// @param value the value of the attribute, if the feature has it
  /// @param feature its number is higher than those of all features before
  /// @throws GeometryError for coordinates that are too large
  void end_feature(const std::optional<std::string>& value = {}, const FeatureName& feature = {});
  /// @brief Joins open lines to rings, and gives all rings their markers. Lines that remain open are faults.
  /// @param expected what the file should contain; used in the message if it contains no vertex
  /// @throws GeometryError under the conditions of check_reading; ConfigError if no feature has the attribute
  void finish(const char* expected, Faults faults);

private:
  struct Chain {
    Kind kind;
    std::vector<FilePoint> vertices;
    int polygon = 0; // 0 for lines
  };

  void note_feature(const FeatureName& feature);
  void keep_open(OpenLine line);
  int number_of(const std::optional<std::string>& value);
  void leave_out_open();
  void join_lines();
  void resolve_markers();
  void tell_skipped();

  Contour& contour_;
  RingBuilder builder_;
  std::string attribute_;
  Use use_;
  std::vector<Chain> of_feature_;
  std::vector<OpenLine> open_lines_;
  std::map<std::string, int> numbers_; // number of each value of the attribute, from 1
  std::vector<std::string> values_;    // the value with number k + 1 at index k
  std::set<std::string> attributes_;
  int polygon_ = 0; // number of the last one
  int skipped_ = 0, skipped_line_ = 0;
  std::string skipped_type_;
};

} // namespace trime::contours
