// SPDX-License-Identifier: BSD-3-Clause
// Makes the names of the files of a run, and checks whether files with these names exist. Serial: called on rank 0
// only.
#pragma once

#include "formats/mesh_series.hpp"
#include "io/temporary_file.hpp"

#include <string>
#include <vector>

namespace trime::formats {

/// [bytes] Longest ending that follows NAME in a file name of a run:
/// "_2147483647_bdry_vertices_coords_CCW_1234567890.txt".
inline constexpr std::size_t longest_ending = 51;
/// [bytes] Longest NAME with which all files of a run can be written, even under their temporary names.
inline constexpr std::size_t longest_name = io::longest_file_name - io::longest_temporary_ending - longest_ending;

/// Returns the NAME of a step, such as "NAME_step_000012".
std::string step_name(const std::string& name, int retriangulation);
/// Returns the part of the NAME of steps before the number: "NAME_step_".
std::string step_name_start(const std::string& name);
/// Return the paths of the files that list all meshes of a series.
std::string xdmf_collection(const io::MeshFileOptions& options);
std::string vtkhdf_collection(const io::MeshFileOptions& options);

/// @brief Returns, sorted, the files of steps, collections and text files that a run with these options would
/// overwrite, or that belong to an older run with the same name. The final mesh and its views are left out.
std::vector<std::string> files_of_series(const SeriesOptions& options);

/// Returns whether a file name is that of a file of the run, or of a step with any number.
/// @param name the NAME of the run
bool is_file_of_run(const std::string& file, const std::string& name);

/// @brief Throws if the path exists, even as a link to nothing. If `overwrite` is true, regular files are allowed.
/// @param other_name advice for the user about a device or directory
/// @param advice advice for the user about a file
/// @throws FileError with the advice
void refuse_to_replace(const std::string& path, bool overwrite, const char* other_name, const char* advice);
/// Rank 0 checks all paths as above; if it throws, all ranks throw.
/// @throws FileError on all ranks
/// @note Collective.
void refuse_to_replace(const std::vector<std::string>& paths, bool overwrite, const char* advice,
                       const comm::Communicator& comm);

/// Does the work of MeshSeries::check() on rank 0.
std::vector<std::string> check_files(const SeriesOptions& options, double expected_points);
/// Does the work of MeshSeries::look() on rank 0.
std::vector<std::string> look_at_files(const SeriesOptions& options, double expected_points);

} // namespace trime::formats
