// SPDX-License-Identifier: BSD-3-Clause
// Counts at how many points each of several sizes is the smallest one, and reports it.
#pragma once

#include "sizing/minimum_size.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/io/metadata.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/record/verdict.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::record {

/// A size that is the smallest one of several sizes, or smaller than all of them at some places.
struct CombinedSize {
  const sizing::SizeField* field = nullptr;     ///< the size of the mesh, up to a factor
  const sizing::MinimumSize* minimum = nullptr; ///< the smallest one of several sizes; null: there is one size
  std::vector<std::string> names{};             ///< names of these sizes, in their order
  std::string lowered_by{}; ///< what makes `field` smaller than `minimum`, such as "size_at"; empty: nothing does
};

/// Says how many points have each of several sizes as the smallest one.
struct SizeShares {
  std::vector<std::string> names; ///< CombinedSize::names, and lowered_by if it is set; empty if there is one size
  std::vector<std::int64_t> points;
};

/// @brief Counts the points at which each of several sizes is the smallest one. Points where `size_at` or a region
/// asks for less count for these.
/// Collective. Cost: one evaluation per point and size, by all threads.
SizeShares shares_of_sizes(const CombinedSize& size, const mesh::DistributedMesh& mesh, const comm::Communicator& comm);

/// Returns a text such as "[sizing] 60 %, [size.wave] 40 % of the points"; empty if there is one size.
std::string text_of(const SizeShares& shares);

/// Returns the shares as a group of the mesh file.
io::MetadataGroup group_of(const SizeShares& shares);
/// Returns the shares in the metadata of a file; none if it has no group with them.
/// @throws FileError on this rank alone if a column is missing
std::vector<SizeShare> shares_of(const io::Metadata& metadata);

} // namespace trime::record
