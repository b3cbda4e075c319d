// SPDX-License-Identifier: BSD-3-Clause
// From the options of a run to its size field.
#pragma once

#include "app/options.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/formula.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <optional>
#include <string>

namespace trime::app {

/// A size field with what it needs to live. Move-only.
struct BuiltSize {
  std::unique_ptr<const Formula> formula; ///< formula of an expression
  std::unique_ptr<const sizing::SizeField> field;
  std::string description; ///< for the report: "automatic, gradation 0.1, features of 0.004 and more"
};

/// @throws ConfigError on all ranks together
/// @note Collective.
BuiltSize build_size(const RunOptions& options, const geometry::Domain& domain, const comm::Communicator& comm);

} // namespace trime::app
