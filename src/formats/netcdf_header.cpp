// SPDX-License-Identifier: BSD-3-Clause
// The NetCDF Users' Guide, appendix "File Format Specifications", has the grammar.
#include "formats/netcdf_header.hpp"

#include <bit>

namespace trime::formats {
namespace {

constexpr std::int32_t dimension_tag = 10, variable_tag = 11, attribute_tag = 12;

template <class Unsigned>
void append_bits(std::string& text, Unsigned bits) {
  for (std::size_t shift = 8 * sizeof bits; shift > 0; shift -= 8)
    text += static_cast<char>(static_cast<unsigned char>(bits >> (shift - 8)));
}

std::int64_t padded(std::int64_t bytes) {
  return (bytes + 3) / 4 * 4;
}
void pad(std::string& text, std::size_t bytes) {
  text.append(static_cast<std::size_t>(padded(static_cast<std::int64_t>(bytes))) - bytes, '\0');
}

} // namespace

void append_big(std::string& text, std::int32_t number) {
  append_bits(text, static_cast<std::uint32_t>(number));
}
void append_big(std::string& text, std::int64_t number) {
  append_bits(text, static_cast<std::uint64_t>(number));
}
void append_big(std::string& text, float number) {
  append_bits(text, std::bit_cast<std::uint32_t>(number));
}
void append_big(std::string& text, double number) {
  append_bits(text, std::bit_cast<std::uint64_t>(number));
}

std::int64_t bytes_of(NetcdfType type) {
  switch (type) {
  case NetcdfType::character:
    return 1;
  case NetcdfType::int32:
  case NetcdfType::float32:
    return 4;
  default:
    return 8;
  }
}

std::size_t NetcdfHeader::dimension(const std::string& name, std::int64_t length) {
  dimensions_.push_back({name, length});
  return dimensions_.size() - 1;
}

bool NetcdfHeader::is_unlimited(const NetcdfVariable& variable) const {
  return !variable.dimensions.empty() && dimensions_[variable.dimensions[0]].length == 0;
}

std::int64_t NetcdfHeader::size_of(const NetcdfVariable& variable) const {
  std::int64_t bytes = bytes_of(variable.type);
  for (const std::size_t dimension : variable.dimensions)
    bytes *= dimensions_[dimension].length == 0 ? 1 : dimensions_[dimension].length;
  return bytes;
}

std::size_t NetcdfHeader::padding() const {
  const std::int64_t bytes = size_of(variables_.back());
  return static_cast<std::size_t>(padded(bytes) - bytes);
}

void NetcdfHeader::append_count(std::string& text, std::int64_t count) const {
  if (format_ == NetcdfFormat::data_64)
    append_big(text, count);
  else
    append_big(text, static_cast<std::int32_t>(static_cast<std::uint32_t>(count)));
}

void NetcdfHeader::append_name(std::string& text, const std::string& name) const {
  append_count(text, std::ssize(name));
  text += name;
  pad(text, name.size());
}

/// Begins a list; an empty one has no tag.
void NetcdfHeader::append_list(std::string& text, std::int32_t tag, std::size_t count) const {
  append_big(text, count == 0 ? 0 : tag);
  append_count(text, static_cast<std::int64_t>(count));
}

void NetcdfHeader::append_attributes(std::string& text, const std::vector<NetcdfAttribute>& attributes) const {
  append_list(text, attribute_tag, attributes.size());
  for (const auto& [name, value] : attributes) {
    append_name(text, name);
    if (const auto* words = std::get_if<std::string>(&value)) {
      append_big(text, static_cast<std::int32_t>(NetcdfType::character));
      append_name(text, *words);
    } else if (const auto* number = std::get_if<std::int32_t>(&value)) {
      append_big(text, static_cast<std::int32_t>(NetcdfType::int32));
      append_count(text, 1);
      append_big(text, *number);
    } else if (const auto* id = std::get_if<std::int64_t>(&value)) {
      append_big(text, static_cast<std::int32_t>(NetcdfType::int64));
      append_count(text, 1);
      append_big(text, *id);
    } else if (const auto* single = std::get_if<float>(&value)) {
      append_big(text, static_cast<std::int32_t>(NetcdfType::float32));
      append_count(text, 1);
      append_big(text, *single);
    } else {
      append_big(text, static_cast<std::int32_t>(NetcdfType::float64));
      append_count(text, 1);
      append_big(text, std::get<double>(value));
    }
  }
}

std::string NetcdfHeader::text(std::int64_t first_array) const {
  std::string text = "CDF";
  text += static_cast<char>(format_);
  append_count(text, 0); // rows along the unlimited dimension
  append_list(text, dimension_tag, dimensions_.size());
  for (const auto& [name, length] : dimensions_) {
    append_name(text, name);
    append_count(text, length);
  }
  append_attributes(text, attributes_);
  append_list(text, variable_tag, variables_.size());
  std::int64_t end = first_array;
  for (const NetcdfVariable& variable : variables_)
    end += is_unlimited(variable) ? 0 : padded(size_of(variable));
  std::int64_t place = first_array;
  for (const NetcdfVariable& variable : variables_) {
    append_name(text, variable.name);
    append_count(text, std::ssize(variable.dimensions));
    for (const std::size_t dimension : variable.dimensions)
      append_count(text, static_cast<std::int64_t>(dimension));
    append_attributes(text, variable.attributes);
    append_big(text, static_cast<std::int32_t>(variable.type));
    append_count(text, padded(size_of(variable)));
    append_big(text, is_unlimited(variable) ? end : place);
    place += is_unlimited(variable) ? 0 : padded(size_of(variable));
  }
  return text;
}

std::string NetcdfHeader::bytes() const {
  return text(std::ssize(text(0))); // its length does not depend on the places
}

} // namespace trime::formats
