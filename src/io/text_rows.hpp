// SPDX-License-Identifier: BSD-3-Clause
// Writes a text file of all ranks together. Each rank makes the lines of its rows, which follow each other in the order
// of the ranks, so the bytes do not depend on how rows are distributed. Only rank 0 accesses the file.
#pragma once

#include "trime/comm/communicator.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace trime::io {

class RunFiles;

/// The rows of one array over all ranks.
struct TextRows {
  std::int64_t rows = 0; ///< number of rows on this rank
  /// Appends the lines of one row of this rank to a text; a row may have no lines. Called concurrently, and must give
  /// the same bytes at each call.
  std::function<void(std::int64_t row, std::string& text)> append;
};

/// Appends a number with 17 significant digits, as printf("%.17g") prints it. Reading the text gives the same double.
void append_number(std::string& text, double number);
void append_number(std::string& text, std::int64_t number);

/// @brief Writes all rows of the first array, then those of the second, and so on, under a temporary name; then renames
/// the file. If there are several ranks, each makes the lines of long arrays twice, the first time only to count bytes;
/// short arrays that follow each other are written in one exchange. Memory: about 30 MB on rank 0, and 30 MB divided by
/// the number of ranks on each other rank.
/// @param files keeps the name of the temporary file, see MeshFileOptions::run_files; may be null
/// @throws FileError on all ranks together
/// @note Collective.
void write_text_rows(const std::string& final_path, std::span<const TextRows> arrays, RunFiles* files,
                     const comm::Communicator& comm);

} // namespace trime::io
