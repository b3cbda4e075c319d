// SPDX-License-Identifier: BSD-3-Clause
// Makes the size field from the options of a run.
#pragma once

#include "app/field_builder.hpp"
#include "app/options.hpp"
#include "core/distance_formula.hpp"
#include "sizing/minimum_size.hpp"
#include "sizing/region_size.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/io/metadata.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace trime::app {

/// A size field together with the objects that it refers to. Move-only.
struct BuiltSize {
  std::vector<std::unique_ptr<const DistanceFormula>>
      formulas; ///< the formulas of the size and of the sections [size.NAME]
  std::vector<std::unique_ptr<const sizing::SizeField>> bases; ///< sizes that `field` lowers or is the smallest of
  std::unique_ptr<const sizing::SizeField> field;
  const sizing::MinimumSize* minimum = nullptr; ///< the smallest one of several sizes, among the bases; null: one size
  std::vector<std::string> names;               ///< the sections with these sizes
  std::string lowered_by;  ///< what makes `field` smaller than `minimum`, such as "size_at"; empty: nothing does
  std::string description; ///< text for the report, such as "automatic, gradation 0.1, features of 0.004 and more"
};

/// Says how many points have each of several sizes as the smallest one.
struct SizeShares {
  std::vector<std::string> names; ///< BuiltSize::names, and lowered_by if it is set; empty if there is one size
  std::vector<std::int64_t> points;
};

/// @brief Counts the points at which each of several sizes is the smallest one. Points where `size_at` or a region
/// asks for less count for these.
/// Collective. Cost: one evaluation per point and size, by all threads.
SizeShares shares_of_sizes(const BuiltSize& size, const mesh::DistributedMesh& mesh, const comm::Communicator& comm);

/// Returns a text such as "[sizing] 60 %, [size.wave] 40 % of the points"; empty if there is one size.
std::string text_of(const SizeShares& shares);

/// Returns the shares as a group of the mesh file.
io::MetadataGroup group_of(const SizeShares& shares);

/// Makes a formula that may use data, and distances to the boundary and its parts.
/// @throws ConfigError that says what is wrong with a name; the same on all ranks
DistanceFormula build_formula(const FormulaText& formula, const geometry::Domain& domain,
                              const std::vector<BuiltField>& fields);

/// Makes the size field. @param bounds sizes in regions, in addition to those of the options
/// @throws ConfigError on all ranks together
/// @note Collective.
BuiltSize build_size(const RunOptions& options, const geometry::Domain& domain, const comm::Communicator& comm,
                     std::vector<sizing::RegionBound> bounds = {}, const std::vector<BuiltField>& fields = {});

} // namespace trime::app
