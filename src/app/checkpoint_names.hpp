// SPDX-License-Identifier: BSD-3-Clause
// Makes the names of the checkpoints of a run, NAME.checkpoint-K.h5, and finds the files with such names. Serial:
// called on rank 0 only.
#pragma once

#include "trime/io/mesh_file.hpp"

#include <string>
#include <vector>

namespace trime::app {

/// The largest value of the key `checkpoint.keep`, and so of the number K in file names.
inline constexpr int most_checkpoints = 1000;

/// Returns the path of a checkpoint.
/// @param slot the number K, from 1
std::string checkpoint_path(const io::MeshFileOptions& output, int slot);

/// Returns the number K in the name of a checkpoint file; 0 for other files.
/// @param file the name of the file
/// @param name the NAME of the run
int checkpoint_slot(const std::string& file, const std::string& name);

/// Returns the paths of all checkpoints of this run in the output directory, ordered by K. They may come from runs with
/// a larger `checkpoint.keep`. The directory need not exist.
std::vector<std::string> checkpoint_files(const io::MeshFileOptions& output);

} // namespace trime::app
