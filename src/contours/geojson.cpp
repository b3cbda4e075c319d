// SPDX-License-Identifier: BSD-3-Clause
// GeoJSON as a stream, so that every vertex knows its line and a large file is not kept as a tree.
#include "contours/contour_text.hpp"
#include "contours/feature_rings.hpp"
#include "contours/map_features.hpp"
#include "core/quoted.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <optional>

namespace trime::contours {
namespace {

using geometry::Vec2;

/// Characters of a text, and the line of the last one that was read.
class LineIterator {
public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  LineIterator(const char* at, int* line) : at_(at), line_(line) {}
  reference operator*() const { return *at_; }
  LineIterator& operator++() {
    if (ends_line_)
      ++*line_;
    ends_line_ = *at_ == '\n';
    ++at_;
    return *this;
  }
  bool operator==(const LineIterator& other) const { return at_ == other.at_; }
  bool operator!=(const LineIterator& other) const { return at_ != other.at_; }

private:
  const char* at_;
  int* line_;
  bool ends_line_ = false; // the character before this one
};

using Chain = std::vector<FilePoint>; // an array of positions

/// Takes events of the parser. Whatever the type of an object turns out to be, its coordinates are kept until then.
class GeoJsonReader {
public:
  GeoJsonReader(Contour& contour, const std::string& attribute, const int& line, FeatureRings::Use use)
      : contour_(contour), rings_(contour, attribute, use), attribute_(attribute), line_(line) {}

  bool null() { return other_value(); }
  bool boolean(bool is_true) {
    take_attribute([&] { return std::string(is_true ? "true" : "false"); });
    return other_value();
  }
  bool number_integer(std::int64_t number) { return number_of(number); }
  bool number_unsigned(std::uint64_t number) { return number_of(number); }
  bool number_float(double number, const std::string&) { return number_of(number); }
  bool binary(nlohmann::json::binary_t&) { return other_value(); }
  bool string(std::string& text) {
    if (!objects_.empty() && objects_.back().arrays.empty() && objects_.back().lists == 0 &&
        objects_.back().key == "type")
      objects_.back().type = text;
    constexpr std::size_t depth = 3; // "crs": {"properties": {"name": ...}} of the whole, as GeoJSON had it before 2016
    if (objects_.size() == depth && objects_[0].key == "crs" && objects_[1].key == "properties" &&
        objects_[2].key == "name")
      contour_.crs = text;
    take_attribute([&] { return std::string(trimmed(text)); });
    note_name([&] { return text; });
    return other_value();
  }
  bool start_object(std::size_t) {
    other_value();
    if (objects_.size() == 1 && is_feature_at(1)) {
      feature_ = {feature_.number + 1};
      name_rank_ = 0;
    }
    Object object;
    object.is_property = !objects_.empty() && (objects_.back().is_property || objects_.back().key == "properties");
    objects_.push_back(std::move(object));
    return true;
  }
  bool key(std::string& text) {
    objects_.back().key = text;
    if (is_attribute())
      objects_[objects_.size() - 2].attributes.push_back(text);
    return true;
  }
  bool end_object() {
    const Object object = std::move(objects_.back());
    objects_.pop_back();
    if (!object.is_property)
      add_rings(object);
    if (object.type == "Feature" && is_feature_at(objects_.size())) {
      for (const std::string& name : object.attributes)
        rings_.has_attribute(name);
      if (objects_.empty()) // the whole text is this feature
        feature_.number = 1;
      rings_.end_feature(object.attribute, feature_);
    }
    return true;
  }
  bool start_array(std::size_t) {
    if (objects_.empty())
      return true; // refused at the end: there is no polygon
    if (Object& object = objects_.back(); object.key == "coordinates" && object.lists == 0 && !object.is_property) {
      object.has_coordinates = true;
      object.arrays.push_back({line_, 0, {}, {}});
    } else
      ++object.lists;
    return true;
  }
  bool end_array() {
    if (!is_in_coordinates()) {
      if (!objects_.empty())
        --objects_.back().lists;
      return true;
    }
    Object& object = objects_.back();
    const Array array = std::move(object.arrays.back());
    object.arrays.pop_back();
    if (array.numbers > 0) {
      if (array.numbers < 2)
        refuse(array.line, "expected a position of two numbers [x, y] or more, found one");
      (object.arrays.empty() ? object.alone : object.arrays.back().positions).push_back({array.place, array.line});
    } else if (!array.positions.empty()) {
      object.chains.push_back(array.positions);
      object.polygons.push_back(object.polygon);
    } else {
      ++object.polygon;
    }
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception&) {
    refuse(line_, fmt::format("expected JSON, found '{}' at character {}; the file is damaged or cut off here, or not "
                              "GeoJSON",
                              shown(token), position));
  }

  /// Returns the places of all geometries Point and MultiPoint.
  const std::vector<FilePoint>& points() const { return points_; }
  void finish(Faults faults) { rings_.finish("GeoJSON with a Polygon or MultiPolygon", faults); }

private:
  struct Array {
    int line;
    int numbers; // directly in it
    Vec2 place;  // the first two of them
    Chain positions;
  };
  struct Object {
    std::string key, type;
    std::vector<Array> arrays; // that are open, inside `coordinates`
    std::vector<Chain> chains;
    std::vector<int> polygons; // the polygon of each chain, counted in this object
    Chain alone;               // the position that is all of `coordinates`
    int polygon = 0;           // number of polygons that have ended
    int lists = 0;             // other arrays that are open
    bool has_coordinates = false;
    bool is_property = false;             // of something, or part of one: its type and coordinates are not a geometry
    std::vector<std::string> attributes;  // names of its properties, if it turns out to be a feature
    std::optional<std::string> attribute; // that of them which names the boundary
  };

  [[noreturn]] void refuse(int line, const std::string& what) const {
    const std::string feature = objects_.size() > 1 ? in_brackets(feature_.number, feature_.name) : "";
    throw GeometryError(fmt::format("{}: {}", place_of_line(contour_, line, feature), what));
  }

  static std::string shown(const std::string& token) {
    constexpr std::size_t most = 40;
    return token.size() > most ? "..." + token.substr(token.size() - most) : token;
  }

  /// Would an object inside of this number of others be a feature? The whole may be, or a member of its `features`.
  bool is_feature_at(std::size_t depth) const {
    return depth == 0 || (depth == 1 && objects_[0].key == "features" && objects_[0].lists == 1);
  }
  /// Is the present value itself one of the `properties` of what may be a feature? Parts of such values do not count.
  bool is_attribute() const {
    const std::size_t depth = objects_.size();
    return depth > 1 && objects_[depth - 2].key == "properties" && objects_[depth - 2].lists == 0 &&
           objects_[depth - 1].lists == 0 && is_feature_at(depth - 2);
  }
  bool is_in_coordinates() const { return !objects_.empty() && !objects_.back().arrays.empty(); }

  template <class Text>
  void take_attribute(const Text& text) {
    if (!attribute_.empty() && is_attribute() && objects_.back().key == attribute_)
      objects_[objects_.size() - 2].attribute = text();
  }

  /// Keeps the attribute by which people recognise the feature best; of equally good ones the first.
  template <class Text>
  void note_name(const Text& text) {
    const std::size_t depth = objects_.size();
    const bool is_id = depth > 0 && objects_.back().key == "id" && objects_.back().lists == 0 &&
                       !objects_.back().is_property && is_feature_at(depth - 1); // of the feature, next to `properties`
    if (!is_attribute() && !is_id)
      return;
    const std::string& key = objects_.back().key;
    if (const int rank = std::max(telling_rank(key), key == attribute_ ? chosen_rank : 0); rank > name_rank_) {
      feature_.name = text();
      name_rank_ = rank;
    }
  }

  template <class Number>
  bool number_of(Number number) {
    take_attribute([&] { return fmt::format("{}", number); });
    note_name([&] { return fmt::format("{}", number); });
    return value(static_cast<double>(number));
  }

  bool value(double number) {
    if (!is_in_coordinates())
      return true;
    Array& array = objects_.back().arrays.back();
    if (array.numbers < 2) // a height may follow
      (array.numbers == 0 ? array.place.x : array.place.y) = number;
    ++array.numbers;
    return true;
  }

  bool other_value() const {
    if (is_in_coordinates())
      refuse(line_, "expected only numbers in 'coordinates', found a text, true, false or null");
    return true;
  }

  void add_rings(const Object& object) {
    const bool is_polygon = object.type == "Polygon" || object.type == "MultiPolygon",
               is_line = object.type == "LineString" || object.type == "MultiLineString";
    if (object.type == "Point")
      points_.insert(points_.end(), object.alone.begin(), object.alone.end());
    if (object.type == "MultiPoint")
      for (const Chain& chain : object.chains)
        points_.insert(points_.end(), chain.begin(), chain.end());
    if (!is_polygon && !is_line) {
      if (!object.type.empty() && object.has_coordinates)
        rings_.skip(object.type, line_);
      return;
    }
    for (std::size_t k = 0; k < object.chains.size(); ++k)
      rings_.add(is_line ? FeatureRings::Kind::line : FeatureRings::Kind::polygon, object.chains[k],
                 k > 0 && object.polygons[k] == object.polygons[k - 1]);
  }

  Contour& contour_;
  FeatureRings rings_;
  const std::string& attribute_;
  const int& line_;
  std::vector<Object> objects_; // that are open
  FeatureName feature_;         // the present one
  int name_rank_ = 0;           // telling_rank of the attribute with its name
  std::vector<FilePoint> points_;
};

} // namespace

namespace {

Contour parse(std::string_view text, const std::string& source, const std::string& attribute, FeatureRings::Use use,
              Faults faults) {
  check_encoding(text, source);
  Contour contour;
  contour.source = source;
  int line = 1;
  GeoJsonReader reader(contour, attribute, line, use);
  nlohmann::json::sax_parse(LineIterator(text.data(), &line), LineIterator(text.data() + text.size(), &line), &reader);
  reader.finish(faults);
  return contour;
}

} // namespace

Contour parse_geojson(std::string_view text, const std::string& source, const std::string& attribute, Faults faults) {
  return parse(text, source, attribute, FeatureRings::Use::rings, faults);
}

Contour parse_geojson_lines(std::string_view text, const std::string& source, const std::string& attribute) {
  return parse(text, source, attribute, FeatureRings::Use::curves, Faults::refuse);
}

std::vector<FilePoint> parse_geojson_points(std::string_view text, const std::string& source) {
  check_encoding(text, source);
  Contour lines; // lines and polygons of the map, which are not used
  lines.source = source;
  const std::string no_attribute;
  int line = 1;
  GeoJsonReader reader(lines, no_attribute, line, FeatureRings::Use::curves);
  nlohmann::json::sax_parse(LineIterator(text.data(), &line), LineIterator(text.data() + text.size(), &line), &reader);
  for (const FilePoint& point : reader.points())
    check_coordinates(point.position, source, point.line);
  if (reader.points().empty())
    throw GeometryError(fmt::format("{}: expected GeoJSON with a Point or MultiPoint, found none", source));
  return reader.points();
}

} // namespace trime::contours
