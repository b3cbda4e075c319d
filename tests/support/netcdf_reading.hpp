// SPDX-License-Identifier: BSD-3-Clause
// Reads a whole netCDF file of the formats CDF-2 and CDF-5, as the NetCDF Users' Guide describes them, with separate
// code: texts and numbers by the name of their variable.
#pragma once

#include "trime/core/error.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace trime::test {

struct NetcdfVariable {
  std::int64_t type = 0;
  std::vector<std::int64_t> shape;
  std::map<std::string, std::string> texts; ///< attributes
  std::vector<double> numbers;              ///< empty for a text
  std::string text;                         ///< all bytes of a text
};

class NetcdfReader {
public:
  std::map<std::string, std::int64_t> dimensions, attributes; ///< attributes: those of one integer
  std::map<std::string, NetcdfVariable> variables;

  explicit NetcdfReader(const std::string& bytes) : bytes_(bytes) {
    expect(bytes.substr(0, 3) == "CDF" && (bytes.at(3) == 2 || bytes.at(3) == 5), "the magic number");
    is_wide_ = bytes[3] == 5;
    at_ = 4;
    expect(count() == 0, "no records");
    std::vector<std::int64_t> lengths;
    for (std::int64_t left = list(10); left > 0; --left) {
      const std::string name = words();
      lengths.push_back(count());
      dimensions[name] = lengths.back();
    }
    read_attributes(nullptr);
    std::int64_t end = 0;
    for (std::int64_t left = list(11); left > 0; --left)
      end = std::max(end, read_variable(lengths));
    expect(end == std::ssize(bytes), "no bytes behind the last array");
  }

private:
  static void expect(bool holds, const char* what) {
    if (!holds)
      throw FileError(std::string("netCDF: expected ") + what);
  }
  std::int64_t integer(std::size_t size) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < size; ++k)
      bits = bits << 8 | static_cast<unsigned char>(bytes_.at(at_++));
    return size == 4 ? static_cast<std::int32_t>(bits) : static_cast<std::int64_t>(bits);
  }
  std::int64_t count() { return integer(is_wide_ ? 8 : 4); }
  std::string words() {
    const auto length = static_cast<std::size_t>(count());
    const std::string text = bytes_.substr(at_, length);
    expect(text.size() == length, "a complete name");
    at_ += (length + 3) / 4 * 4;
    return text;
  }
  std::int64_t list(std::int64_t wanted) {
    const std::int64_t tag = integer(4), length = count();
    expect(tag == (length == 0 ? 0 : wanted), "the tag of a list");
    return length;
  }
  void read_attributes(NetcdfVariable* variable) {
    for (std::int64_t left = list(12); left > 0; --left) {
      const std::string name = words();
      const std::int64_t type = integer(4);
      if (type == 2) {
        const std::string text = words();
        if (variable)
          variable->texts[name] = text;
        continue;
      }
      expect(count() == 1 && (type == 4 || type == 5), "one number");
      attributes[name] = integer(4);
    }
  }
  std::int64_t read_variable(const std::vector<std::int64_t>& lengths) {
    NetcdfVariable& variable = variables[words()];
    std::int64_t items = 1;
    for (std::int64_t left = count(); left > 0; --left) {
      variable.shape.push_back(lengths.at(static_cast<std::size_t>(count())));
      items *= variable.shape.back();
    }
    read_attributes(&variable);
    variable.type = integer(4);
    const std::int64_t size = variable.type == 2 ? 1 : variable.type == 4 ? 4 : 8;
    const std::int64_t bytes = (items * size + 3) / 4 * 4;
    expect(count() == (items == 0 ? size : bytes), "the size of an array");
    const std::int64_t begin = integer(8);
    const std::size_t next = at_;
    at_ = static_cast<std::size_t>(begin);
    for (std::int64_t k = 0; k < items; ++k)
      if (variable.type == 2)
        variable.text += bytes_.at(at_++);
      else if (variable.type == 6)
        variable.numbers.push_back(std::bit_cast<double>(integer(8)));
      else
        variable.numbers.push_back(static_cast<double>(integer(static_cast<std::size_t>(size))));
    at_ = next;
    return begin + bytes;
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
  bool is_wide_ = false;
};

} // namespace trime::test
