// SPDX-License-Identifier: BSD-3-Clause
// A text file that all ranks write together. Each rank makes the lines of its rows, which follow in the order of the
// ranks, so the bytes do not depend on how the rows are distributed. Only rank 0 accesses the file.
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
  std::int64_t rows = 0; ///< rows of this rank
  /// Appends the lines of a row of this rank, if it has any. Called concurrently, and must give the same bytes at each
  /// call.
  std::function<void(std::int64_t row, std::string& text)> append;
};

/// Appends a number with 17 significant digits, as "%.17g" prints it: reading it gives the same number.
void append_number(std::string& text, double number);
void append_number(std::string& text, std::int64_t number);

/// @brief Writes all rows of the first array, then those of the second, and so on, under a temporary name; then renames
/// the file. With several ranks, each makes its lines twice, first to count bytes. Needs about 30 MB on rank 0, and a
/// share of that on other ranks.
/// @param files see MeshFileOptions::run_files
/// @throws FileError on all ranks together
/// @note Collective.
void write_text_rows(const std::string& final_path, std::span<const TextRows> arrays, RunFiles* files,
                     const comm::Communicator& comm);

} // namespace trime::io
