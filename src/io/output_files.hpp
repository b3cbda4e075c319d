// SPDX-License-Identifier: BSD-3-Clause
// Names of the files of a run, and the look at what lies under these names already. Serial: rank 0 only.
#pragma once

#include "io/temporary_file.hpp"
#include "trime/io/mesh_series.hpp"

#include <string>
#include <vector>

namespace trime::io {

/// Bytes that files of a run have behind NAME at most, "_2147483647_bdry_vertices_coords_CCW_1234567890.txt".
inline constexpr std::size_t longest_ending = 51;
/// Bytes of NAME, so that all files of a run can be written, under their temporary names first.
inline constexpr std::size_t longest_name = longest_file_name - longest_temporary_ending - longest_ending;

/// "NAME_step_000012".
std::string step_name(const std::string& name, int retriangulation);
/// "NAME_step_", before the number.
std::string step_name_start(const std::string& name);
/// The view of the facets of a mesh.
std::string facet_view(const MeshFileOptions& options);
/// The collections of a series.
std::string xdmf_collection(const MeshFileOptions& options);
std::string vtkhdf_collection(const MeshFileOptions& options);

/// @brief Returns, sorted, files of steps, collections, and text files that a run with these options would overwrite,
/// or that belong to an older run with this name. The final mesh and its views are not among them.
std::vector<std::string> files_of_series(const SeriesOptions& options);

/// Has a file in the output directory such a name, steps of any number included? @param name stem of the run's files
bool is_file_of_run(const std::string& file, const std::string& name);

/// Does the work of MeshSeries::check() on rank 0.
std::vector<std::string> check_files(const SeriesOptions& options, double expected_points);
/// Does the work of MeshSeries::look() on rank 0.
std::vector<std::string> look_at_files(const SeriesOptions& options, double expected_points);

} // namespace trime::io
