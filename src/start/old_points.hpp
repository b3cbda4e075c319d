// SPDX-License-Identifier: BSD-3-Clause
// The points of an old mesh, from which a new mesh starts, and what became of them.
#pragma once

#include "mesh/site.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/start/start_choice.hpp"

#include <cstdint>
#include <string>

namespace trime::start {

struct DensityChanges;

/// Numbers of points over all ranks.
struct OldPointsSummary {
  std::int64_t all = 0;     ///< points of the old mesh, as far as they lie in the container
  std::int64_t kept = 0;    ///< points in the new shape, away from its boundary
  std::int64_t removed = 0; ///< points that were taken out, because the new size is larger there
  std::int64_t inserted = 0;

  void add(const DensityChanges& changes);
  /// Returns whether so few sites have changed that the new mesh is regular nearly everywhere.
  bool is_small() const;
  /// Returns one line for the log.
  std::string text(const OldPoints& old) const;
};

/// Returns the points of this rank that lie in the container, on its lattice.
mesh::SiteList sites_of(const OldPoints& old, const geometry::Frame& frame);

/// Returns the message for an old mesh without points in the shape.
std::string no_point_of(const OldPoints& old, std::int64_t in_container);

/// @throws ConfigError, which names the mesh and its periods, unless the periods are those of the container
void check_periods(const OldPoints& old, const geometry::Periods& periods);

} // namespace trime::start
