// SPDX-License-Identifier: BSD-3-Clause
// Makes the size field from the options of a run.
#pragma once

#include "app/field_builder.hpp"
#include "app/options.hpp"
#include "core/distance_formula.hpp"
#include "record/size_shares.hpp"
#include "sizing/minimum_size.hpp"
#include "sizing/region_size.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

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

  record::CombinedSize combined() const { return {field.get(), minimum, names, lowered_by}; }
};

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
