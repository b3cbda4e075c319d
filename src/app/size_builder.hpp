// SPDX-License-Identifier: BSD-3-Clause
// From the options of a run to its size field.
#pragma once

#include "app/options.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/formula.hpp"
#include "trime/geometry/domain.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <optional>
#include <string>

namespace trime::app {

/// A size field with what it needs to live. Move-only.
struct BuiltSize {
  std::unique_ptr<const Formula> formula; ///< of an expression
  std::unique_ptr<const sizing::SizeField> field;
  std::string description; ///< for the report: "automatic, gradation 0.1, features of 0.004 and more"
};

/// @brief Length below which the automatic size does not look at features: half the mean edge length of the mesh.
/// A mesh of that many points cannot show smaller features, and at a corner of a polygon, where the medial axis meets
/// the boundary, the local feature size is 0: without a floor all points would crowd there.
/// @return 0.5 sqrt(2/sqrt(3) area/points), the edges of equilateral triangles (two for each point), or half the
/// edge length that was asked for
double feature_floor(const meshing::MeshOptions& mesh, double area);

/// @throws ConfigError on all ranks together
/// @note Collective.
BuiltSize build_size(const RunOptions& options, const geometry::Domain& domain, const comm::Communicator& comm);

} // namespace trime::app
