// SPDX-License-Identifier: BSD-3-Clause
// Names of the checkpoints of a run, NAME.checkpoint-K.h5, and the files that have such names. Serial: rank 0 only.
#pragma once

#include "trime/io/mesh_file.hpp"

#include <string>
#include <vector>

namespace trime::app {

/// Largest `checkpoint.keep`, and so largest K.
inline constexpr int most_checkpoints = 1000;

/// @param slot K, from 1
std::string checkpoint_path(const io::MeshFileOptions& output, int slot);

/// K of the name of a file, as any `keep` may have made it; 0 of another file. @param name stem of the files of the run
int checkpoint_slot(const std::string& file, const std::string& name);

/// Checkpoints of any `keep` that lie in the output directory, which need not exist; by K.
std::vector<std::string> checkpoint_files(const io::MeshFileOptions& output);

} // namespace trime::app
