// SPDX-License-Identifier: BSD-3-Clause
// Makes sites for tests of the clean-up, distributed over the ranks, in a container without boundary.
#pragma once

#include "cleanup/cleanup_sites.hpp"
#include "support/distributed.hpp"

namespace trime::testing {

/// The objects that cleanup::CleanupSites needs.
/// @pre `state` knows the size at its sites
struct PatchSites {
  PatchSites(const comm::Communicator& comm, const mesh::SiteList& all, const sizing::SizeField& size, double spacing,
             const geometry::Periods& periods)
      : state(comm, {{0, 0}, {1, 1}}, {{}, {}, spacing, periods}), boundary(comm, no_curves, no_sites, size, 0) {
    state.distribute(dealt(comm, all));
    state.refresh(size);
    sites.emplace(state, boundary);
  }
  PatchSites(const PatchSites&) = delete;

  geometry::Boundary no_curves;
  polygon::BoundarySites no_sites;
  sites::SiteState state;
  cleanup::CleanupBoundary boundary;
  std::optional<cleanup::CleanupSites> sites;
};

} // namespace trime::testing
