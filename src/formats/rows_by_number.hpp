// SPDX-License-Identifier: BSD-3-Clause
// Groups the rows of a rank by a number, such as the region of a triangle or the label of an edge, for formats whose
// files have a block for each name.
#pragma once

#include "io/text_rows.hpp"
#include "trime/core/types.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace trime::formats {

/// The rows of this rank by their number: one pass for all blocks of a section. Rows of one number keep their order.
class RowsByNumber {
public:
  /// @param number returns that of a row, from 1 to `most`
  template <class Number>
  RowsByNumber(std::int64_t rows, std::size_t most, const Number& number) : first_(most + 2, 0), rows_(at(rows)) {
    for (std::int64_t row = 0; row < rows; ++row)
      ++first_[at(number(row)) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::int64_t> next = first_;
    for (std::int64_t row = 0; row < rows; ++row)
      rows_[at(next[at(number(row))]++)] = static_cast<LocalIndex>(row);
  }
  std::int64_t count(std::size_t number) const { return first_[number + 1] - first_[number]; }
  std::int64_t row(std::size_t number, std::int64_t k) const { return rows_[at(first_[number] + k)]; }

private:
  static std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

  std::vector<std::int64_t> first_; // by number
  std::vector<LocalIndex> rows_;
};

/// Returns the rows of one number, in their order. `append(row, text)` is called with the number of the row on this
/// rank. The result keeps `by_number`.
template <class Append>
io::TextRows rows_of_number(const std::shared_ptr<const RowsByNumber>& by_number, std::size_t number,
                            const Append& append) {
  return {by_number->count(number),
          [by_number, number, append](std::int64_t k, std::string& to) { append(by_number->row(number, k), to); }};
}

} // namespace trime::formats
