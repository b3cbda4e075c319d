// SPDX-License-Identifier: BSD-3-Clause
// Contours as bytes, which one rank sends to the others.
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"

#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace trime::contours {
namespace {

template <class T>
constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_same_v<T, geometry::Vec2>;

/// Appends values to bytes, or takes them off in the same order.
class Writer {
public:
  template <class T>
  void operator()(const T& value) {
    if constexpr (is_plain<T>)
      bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    else
      list(value);
  }
  void operator()(const ContourRing& ring) { members(*this, ring); }
  void operator()(const Contour& contour) { members(*this, contour); }
  void operator()(const FaultList& faults) { members(*this, faults); }
  void operator()(const Fault& fault) { members(*this, fault); }
  void operator()(const MapFeature& feature) { members(*this, feature); }
  std::string take() { return std::move(bytes_); }

  template <class Visitor, class Ring>
  requires std::is_same_v<std::remove_const_t<Ring>, ContourRing>
  static void members(Visitor& visit, Ring& ring) {
    visit(ring.points);
    visit(ring.lines);
    visit(ring.markers);
    visit(ring.in_file);
    visit(ring.polygon);
    visit(ring.open);
  }
  template <class Visitor, class One>
  requires std::is_same_v<std::remove_const_t<One>, MapFeature>
  static void members(Visitor& visit, One& feature) {
    visit(feature.line);
    visit(feature.name);
  }
  template <class Visitor, class One>
  requires std::is_same_v<std::remove_const_t<One>, Contour>
  static void members(Visitor& visit, One& contour) {
    visit(contour.source);
    visit(contour.rings);
    visit(contour.warnings);
    visit(contour.marker_names);
    visit(contour.largest_areas);
    visit(contour.features);
    visit(contour.crs);
    visit(contour.is_map);
    visit(contour.is_raster);
    visit(contour.in_degrees);
    visit(contour.joins_date_line);
    visit(contour.faults);
  }
  template <class Visitor, class One>
  requires std::is_same_v<std::remove_const_t<One>, FaultList>
  static void members(Visitor& visit, One& faults) {
    visit(faults.first);
    visit(faults.repairable);
    visit(faults.others);
  }
  template <class Visitor, class One>
  requires std::is_same_v<std::remove_const_t<One>, Fault>
  static void members(Visitor& visit, One& fault) {
    visit(fault.where);
    visit(fault.what);
    visit(fault.remedy);
    visit(fault.repaired);
  }

private:
  template <class List>
  void list(const List& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    using Value = typename List::value_type;
    if constexpr (is_plain<Value>)
      bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
    else
      for (const auto& value : values)
        (*this)(value);
  }
  std::string bytes_;
};

class Reader {
public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  void operator()(T& value) {
    if constexpr (is_plain<T>) {
      take(&value, sizeof value);
    } else {
      std::uint64_t size = 0;
      (*this)(size);
      value.resize(size);
      using Value = typename T::value_type;
      if constexpr (is_plain<Value>)
        take(value.data(), size * sizeof(Value));
      else
        for (auto& one : value)
          (*this)(one);
    }
  }
  void operator()(ContourRing& ring) { Writer::members(*this, ring); }
  void operator()(Contour& contour) { Writer::members(*this, contour); }
  void operator()(FaultList& faults) { Writer::members(*this, faults); }
  void operator()(Fault& fault) { Writer::members(*this, fault); }
  void operator()(MapFeature& feature) { Writer::members(*this, feature); }

private:
  void take(void* place, std::size_t count) {
    TRIME_ASSERT(count <= bytes_.size(), "{} bytes left", bytes_.size());
    if (count > 0)
      std::memcpy(place, bytes_.data(), count);
    bytes_.remove_prefix(count);
  }

  std::string_view bytes_;
};

} // namespace

std::string to_bytes(const Contour& contour) {
  Writer write;
  write(contour);
  return write.take();
}

Contour contour_of_bytes(std::string_view bytes) {
  Contour contour;
  Reader{bytes}(contour);
  return contour;
}

} // namespace trime::contours
