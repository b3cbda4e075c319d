// SPDX-License-Identifier: BSD-3-Clause
// Writes groups of arrays of other modules into an HDF5 file.
#pragma once

#include "io/extra_arrays.hpp"
#include "io/slab_file.hpp"

namespace trime::io {

/// Writes a group with its attributes and arrays. Arrays that are long on every rank go to the disk without a gather.
/// @note Collective.
void write_group(SlabFile& file, const ExtraGroup& group);

} // namespace trime::io
