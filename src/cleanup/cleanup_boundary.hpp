// SPDX-License-Identifier: BSD-3-Clause
// The sites on the boundary during the clean-up, of which each rank has a copy.
#pragma once

#include "cleanup/patch_data.hpp"
#include "polygon/boundary_chain.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/sizing/size_field.hpp"

#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief A BoundaryChain that is the same on all ranks, and how far new chords may pass from its curves.
class CleanupBoundary {
public:
  /// @brief Collective. References must outlive the object.
  /// @param tolerance in `size`: how far chords may pass from corners that they leave out; 0: they may leave out none
  CleanupBoundary(const comm::Communicator& comm, const geometry::Boundary& boundary,
                  const polygon::BoundarySites& sites, const sizing::SizeField& size, double tolerance);

  const polygon::BoundaryChain& chain() const { return chain_; }
  /// Of a site of the chain.
  double tolerance(LocalIndex site) const { return tolerances_[static_cast<std::size_t>(site)]; }

  /// @brief All ranks learn what happens on the boundary; new sites get their indices in the edits. Collective.
  void apply(std::vector<SiteEdit>& edits);

  /// See BoundaryChain::renumber.
  std::vector<LocalIndex> renumber() { return chain_.renumber(); }

private:
  void find_tolerances(std::span<const LocalIndex> sites);

  const comm::Communicator& comm_;
  const sizing::SizeField& size_;
  double tolerance_;
  polygon::BoundaryCurve curve_;
  polygon::BoundaryChain chain_;
  std::vector<double> tolerances_; // by index in the chain
};

} // namespace trime::cleanup
