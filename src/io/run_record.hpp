// SPDX-License-Identifier: BSD-3-Clause
// The numbers of a run as one JSON file: for scripts that compare many runs, also of runs that write no mesh.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/io/metadata.hpp"

#include <string>

namespace trime::io {

/// @brief {"attributes": {name: value}, "groups": {group: {"attributes": {...}, "columns": {name: [values]}}}}, the
/// same names as in the group /trime_mpi of a mesh file; the texts are left out. Numbers that are not finite become
/// null, and bytes that are no UTF-8 are replaced, since JSON cannot hold them.
std::string record_text(const Metadata& metadata);

/// @brief Sees that the file can be written; to be called before work starts that would be lost.
/// @throws FileError on all ranks
/// @note Collective.
void check_record(const std::string& path, const comm::Communicator& comm);

/// @brief Writes the metadata of rank 0 to `path`, whole or not at all; a file of this name is replaced.
/// @throws FileError on all ranks
/// @note Collective.
void write_record(const std::string& path, const Metadata& metadata, const comm::Communicator& comm);

} // namespace trime::io
