// SPDX-License-Identifier: BSD-3-Clause
// Describes the content of a netCDF file: dimensions, attributes and variables. The classic netCDF formats begin with
// this header, and the arrays follow it in the order of the variables, in big-endian byte order. So ranks can write
// their slices like those of any other format. The numbers of the arrays are left to others.
#pragma once

#include "trime/core/types.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace trime::formats {

/// Appends the bytes of a number in big-endian order.
void append_big(std::string& text, std::int32_t number);
void append_big(std::string& text, std::int64_t number);
void append_big(std::string& text, float number);
void append_big(std::string& text, double number);

/// The two classic formats without a limit for the size of the file.
enum class NetcdfFormat : char {
  offset_64 = 2, ///< CDF-2: an array has less than 4 GiB, and integers have 32 bits; all readers know it
  data_64 = 5    ///< CDF-5: no limits
};
enum class NetcdfType : std::int32_t { character = 2, int32 = 4, float32 = 5, float64 = 6, int64 = 10 };
std::int64_t bytes_of(NetcdfType type);

struct NetcdfAttribute {
  std::string name;
  std::variant<std::string, std::int32_t, std::int64_t, float, double> value; ///< int64 only in CDF-5
};

struct NetcdfVariable {
  std::string name;
  NetcdfType type;
  std::vector<std::size_t> dimensions; ///< as NetcdfHeader::dimension numbers them, the slowest one first
  std::vector<NetcdfAttribute> attributes{};
};

class NetcdfHeader {
public:
  explicit NetcdfHeader(NetcdfFormat format) : format_(format) {}

  NetcdfFormat format() const { return format_; }
  /// Adds a dimension and returns its number. Length 0: unlimited, without a row so far.
  std::size_t dimension(const std::string& name, std::int64_t length);
  void attribute(NetcdfAttribute attribute) { attributes_.push_back(std::move(attribute)); }
  /// Adds a variable. The array of a variable over an unlimited dimension has no bytes.
  void variable(NetcdfVariable variable) { variables_.push_back(std::move(variable)); }
  /// Returns the number of zeros that must follow the array of the last variable.
  std::size_t padding() const;
  /// Returns the header. The arrays follow in the order of the variables, each with its padding.
  std::string bytes() const;

private:
  struct Dimension {
    std::string name;
    std::int64_t length;
  };

  std::int64_t size_of(const NetcdfVariable& variable) const; // without padding
  bool is_unlimited(const NetcdfVariable& variable) const;
  std::string text(std::int64_t first_array) const;
  void append_count(std::string& text, std::int64_t count) const;
  void append_name(std::string& text, const std::string& name) const;
  void append_list(std::string& text, std::int32_t tag, std::size_t count) const;
  void append_attributes(std::string& text, const std::vector<NetcdfAttribute>& attributes) const;

  NetcdfFormat format_;
  std::vector<Dimension> dimensions_;
  std::vector<NetcdfAttribute> attributes_;
  std::vector<NetcdfVariable> variables_;
};

} // namespace trime::formats
