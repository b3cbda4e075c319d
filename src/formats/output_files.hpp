// SPDX-License-Identifier: BSD-3-Clause
// Makes the names of the files of a run, and checks for existing files with these names. Serial: rank 0 only.
#pragma once

#include "formats/mesh_series.hpp"
#include "io/temporary_file.hpp"

#include <string>
#include <vector>

namespace trime::formats {

/// [bytes] Longest ending of a file of a run after NAME: "_2147483647_bdry_vertices_coords_CCW_1234567890.txt".
inline constexpr std::size_t longest_ending = 51;
/// [bytes] Longest NAME with which all files of a run can be written, also under their temporary names.
inline constexpr std::size_t longest_name = io::longest_file_name - io::longest_temporary_ending - longest_ending;

/// Returns "NAME_step_000012".
std::string step_name(const std::string& name, int retriangulation);
/// Returns "NAME_step_", which comes before the number.
std::string step_name_start(const std::string& name);
/// Return the paths of the collections of a series.
std::string xdmf_collection(const io::MeshFileOptions& options);
std::string vtkhdf_collection(const io::MeshFileOptions& options);

/// @brief Returns, sorted, files of steps, collections, and text files that a run with these options would overwrite,
/// or that belong to an older run with this name. The final mesh and its views are not among them.
std::vector<std::string> files_of_series(const SeriesOptions& options);

/// Returns whether a file in the output directory has a name of a file of the run, or of a step with any number. @param
/// name stem of the files of the run
bool is_file_of_run(const std::string& file, const std::string& name);

/// @brief Refuses a path that something has, also a link to nothing; regular files only if they may not be replaced.
/// @param other_name, advice what the user can do about a device or directory, and about a file
/// @throws FileError
void refuse_to_replace(const std::string& path, bool overwrite, const char* other_name, const char* advice);
/// Does the same on rank 0 for all paths and ranks. @throws FileError on all ranks @note Collective.
void refuse_to_replace(const std::vector<std::string>& paths, bool overwrite, const char* advice,
                       const comm::Communicator& comm);

/// Does the work of MeshSeries::check() on rank 0.
std::vector<std::string> check_files(const SeriesOptions& options, double expected_points);
/// Does the work of MeshSeries::look() on rank 0.
std::vector<std::string> look_at_files(const SeriesOptions& options, double expected_points);

} // namespace trime::formats
