// SPDX-License-Identifier: BSD-3-Clause
// Makes the size field, on every rank, from the size that a program gave.
#pragma once

#include "record/size_shares.hpp"
#include "sizing/minimum_size.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/facade/shape.hpp"
#include "trime/facade/size.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/meshing/options.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace trime {

/// A size field with all objects that it needs, except the functions of the caller.
struct BuiltSize {
  std::shared_ptr<const sizing::SizeField> field;
  std::shared_ptr<const sizing::MinimumSize> minimum{}; ///< the smallest one of several sizes; null: there is one size
  std::vector<std::string> names{}; ///< names of these sizes, as the sections of a config: "size.wave"
  std::string lowered_by{};         ///< "regions" if the sizes of regions bound the size

  record::CombinedSize combined() const { return {field.get(), minimum.get(), names, lowered_by}; }
};

/// Makes the size field, bounded in those regions that have a size.
/// @pre `size` outlives the field
/// @throws ConfigError on all ranks together
/// @note Collective.
BuiltSize build_size(const Size& size, const geometry::Domain& domain, const std::vector<Region>& regions,
                     const meshing::MeshOptions& options, const comm::Communicator& comm);

/// Returns the largest growth of h that a size has by default, as in the program. Empty: the size is used as it is.
/// @param regions_are_sized whether regions bound the size
std::optional<double> default_growth(const Size& size, bool regions_are_sized);

/// Says in the file what the size was.
std::string text_of(const Size& size);

} // namespace trime
