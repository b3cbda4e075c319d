// SPDX-License-Identifier: BSD-3-Clause
// A text file that all ranks write together: each makes the lines of its rows, in the order of the ranks, so that the
// bytes do not depend on how the rows are distributed. Rank 0 alone touches the file.
#pragma once

#include "trime/comm/communicator.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace trime::io {

class RunFiles;

/// Rows of one array over all ranks.
struct TextRows {
  std::int64_t rows = 0; ///< of this rank
  /// Appends the lines of a row of this rank (there may be none). Called concurrently; the same bytes at each call.
  std::function<void(std::int64_t row, std::string& text)> append;
};

/// Appends a number with 17 significant digits, as "%.17g" prints it: reading it gives the same number.
void append_number(std::string& text, double number);
void append_number(std::string& text, std::int64_t number);

/// @brief Writes all rows of the first array, then those of the second, ..., under a temporary name; then gives the
/// file its name. Each rank makes its lines twice on several ranks: first to count bytes. Memory: about 30 MB on rank
/// 0, and a share of that on other ranks.
/// @param files as MeshFileOptions::run_files
/// @throws FileError on all ranks together
/// @note Collective.
void write_text_rows(const std::string& final_path, std::span<const TextRows> arrays, RunFiles* files,
                     const comm::Communicator& comm);

} // namespace trime::io
