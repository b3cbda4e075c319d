// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup_boundary.hpp"

#include "comm/agree.hpp"
#include "core/thread_loop.hpp"

#include <map>
#include <numeric>

namespace trime::cleanup {
namespace {

using polygon::BoundaryEdit;
using polygon::BoundarySites;
using polygon::EditKind;

constexpr int sites_in_a_row = 256; // by one thread

} // namespace

CleanupBoundary::CleanupBoundary(const comm::Communicator& comm, const geometry::Boundary& boundary,
                                 const BoundarySites& sites, const sizing::SizeField& size, double tolerance)
    : comm_(comm), size_(size), tolerance_(tolerance), curve_(boundary), chain_(sites, curve_) {
  std::vector<LocalIndex> all(sites.sites.size());
  std::iota(all.begin(), all.end(), 0);
  find_tolerances(all);
}

void CleanupBoundary::find_tolerances(std::span<const LocalIndex> sites) {
  tolerances_.resize(chain_.sites().sites.size(), 0);
  if (!(tolerance_ > 0))
    return;
  comm::run_agreed(comm_, [&] {
    thread_loop(std::ssize(sites), sites_in_a_row, [&](std::ptrdiff_t k, int) {
      const auto site = static_cast<std::size_t>(sites[static_cast<std::size_t>(k)]);
      tolerances_[site] = tolerance_ * size_.size(chain_.sites().sites[site].position);
    });
  });
}

void CleanupBoundary::apply(std::vector<SiteEdit>& edits) {
  std::vector<BoundaryEdit> own;
  for (const SiteEdit& edit : edits)
    if (edit.boundary >= 0)
      own.push_back({edit.boundary, edit.kind, edit.arc, edit.to, edit.patch});
  const std::size_t before = chain_.sites().sites.size();
  const std::vector<LocalIndex> changed =
      chain_.apply(comm::from_bytes<BoundaryEdit>(comm_.all_gather(std::as_bytes(std::span<const BoundaryEdit>(own)))));
  find_tolerances(changed);
  std::map<std::pair<double, double>, LocalIndex> index_at;
  for (std::size_t k = before; k < chain_.sites().sites.size(); ++k)
    index_at[{chain_.sites().sites[k].position.x, chain_.sites().sites[k].position.y}] = static_cast<LocalIndex>(k);
  for (SiteEdit& edit : edits)
    if (edit.boundary >= 0 && edit.kind == EditKind::insert)
      edit.boundary = index_at.at({edit.to.x, edit.to.y});
}

} // namespace trime::cleanup
