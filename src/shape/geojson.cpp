// SPDX-License-Identifier: BSD-3-Clause
// GeoJSON as a stream, so that every vertex knows its line and a large file is not kept as a tree.
#include "contour_text.hpp"
#include "shape/ring_builder.hpp"
#include "trime/core/error.hpp"
#include "trime/shape/contour.hpp"

#include <nlohmann/json.hpp>

#include <iterator>

namespace trime::shape {
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

struct Vertex {
  Vec2 position;
  int line;
};
using Chain = std::vector<Vertex>; // an array of positions

/// Takes events of the parser. Whatever the type of an object turns out to be, its coordinates are kept until then.
class GeoJsonReader {
public:
  GeoJsonReader(Contour& contour, const int& line) : contour_(contour), builder_(contour), line_(line) {}

  bool null() { return other_value(); }
  bool boolean(bool) { return other_value(); }
  bool number_integer(std::int64_t number) { return value(static_cast<double>(number)); }
  bool number_unsigned(std::uint64_t number) { return value(static_cast<double>(number)); }
  bool number_float(double number, const std::string&) { return value(number); }
  bool binary(nlohmann::json::binary_t&) { return other_value(); }
  bool string(std::string& text) {
    if (!objects_.empty() && objects_.back().arrays.empty() && objects_.back().key == "type")
      objects_.back().type = text;
    constexpr std::size_t depth = 3; // "crs": {"properties": {"name": ...}} of the whole, as GeoJSON had it before 2016
    if (objects_.size() == depth && objects_[0].key == "crs" && objects_[1].key == "properties" &&
        objects_[2].key == "name")
      contour_.crs = text;
    return other_value();
  }
  bool start_object(std::size_t) {
    other_value();
    objects_.push_back({});
    return true;
  }
  bool key(std::string& text) {
    objects_.back().key = text;
    return true;
  }
  bool end_object() {
    const Object object = std::move(objects_.back());
    objects_.pop_back();
    add_rings(object);
    return true;
  }
  bool start_array(std::size_t) {
    if (objects_.empty())
      return true; // refused at the end: there is no polygon
    if (Object& object = objects_.back(); object.key == "coordinates") {
      object.has_coordinates = true;
      object.arrays.push_back({line_, 0, {}, {}});
    }
    return true;
  }
  bool end_array() {
    if (objects_.empty() || objects_.back().arrays.empty())
      return true;
    Object& object = objects_.back();
    const Array array = std::move(object.arrays.back());
    object.arrays.pop_back();
    if (array.numbers > 0) {
      if (array.numbers < 2)
        refuse(array.line, "expected a position of two numbers [x, y] or more, found one");
      if (!object.arrays.empty())
        object.arrays.back().positions.push_back({array.place, array.line});
    } else if (!array.positions.empty())
      object.chains.push_back(array.positions);
    return true;
  }
  bool parse_error(std::size_t, const std::string& token, const nlohmann::json::exception&) {
    refuse(line_, fmt::format("expected JSON, found '{}'", shown(token)));
  }

  void finish() {
    builder_.finish("GeoJSON with a Polygon or MultiPolygon");
    if (skipped_ > 0)
      contour_.warnings.push_back(fmt::format("{}:{}: {} geometr{} of type {} or the like left out: only polygons and "
                                              "closed lines bound a shape",
                                              contour_.source, skipped_line_, skipped_, skipped_ == 1 ? "y" : "ies",
                                              skipped_type_));
  }

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
    bool has_coordinates = false;
  };

  [[noreturn]] void refuse(int line, const std::string& what) const {
    throw GeometryError(fmt::format("{}:{}: {}", contour_.source, line, what));
  }

  static std::string shown(const std::string& token) {
    constexpr std::size_t most = 40;
    return token.size() > most ? "..." + token.substr(token.size() - most) : token;
  }

  bool value(double number) {
    if (objects_.empty() || objects_.back().arrays.empty())
      return true;
    Array& array = objects_.back().arrays.back();
    if (array.numbers < 2) // a height may follow
      (array.numbers == 0 ? array.place.x : array.place.y) = number;
    ++array.numbers;
    return true;
  }

  bool other_value() const {
    if (!objects_.empty() && !objects_.back().arrays.empty())
      refuse(line_, "expected numbers in 'coordinates', found something else");
    return true;
  }

  void add_rings(const Object& object) {
    const bool is_polygon = object.type == "Polygon" || object.type == "MultiPolygon",
               is_line = object.type == "LineString" || object.type == "MultiLineString";
    if (!is_polygon && !is_line) {
      if (!object.type.empty() && object.has_coordinates) {
        ++skipped_;
        skipped_line_ = line_;
        skipped_type_ = object.type;
      }
      return;
    }
    for (const Chain& chain : object.chains) {
      if (is_line && chain.front().position != chain.back().position)
        refuse(chain.back().line,
               fmt::format("expected a polygon, or a line that ends where it starts, at ({}, {}); found a {} that ends "
                           "at ({}, {}): close it, or make a polygon of it",
                           chain.front().position.x, chain.front().position.y, object.type, chain.back().position.x,
                           chain.back().position.y));
      for (const Vertex& vertex : chain)
        builder_.add(vertex.position, vertex.line);
      builder_.end_ring();
    }
  }

  Contour& contour_;
  RingBuilder builder_;
  const int& line_;
  std::vector<Object> objects_; // that are open
  int skipped_ = 0, skipped_line_ = 0;
  std::string skipped_type_;
};

} // namespace

Contour parse_geojson(std::string_view text, const std::string& source) {
  check_encoding(text, source);
  Contour contour;
  contour.source = source;
  int line = 1;
  GeoJsonReader reader(contour, line);
  nlohmann::json::sax_parse(LineIterator(text.data(), &line), LineIterator(text.data() + text.size(), &line), &reader);
  reader.finish();
  return contour;
}

} // namespace trime::shape
