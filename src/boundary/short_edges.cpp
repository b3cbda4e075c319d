// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/short_edges.hpp"

#include "boundary/site_tree.hpp"
#include "comm/agree.hpp"

namespace trime::boundary {

using geometry::ShortEdge;

namespace {

constexpr int sites_in_a_row = 64; // by one thread

SiteTree tree_of(const polygon::BoundarySites& boundary) {
  std::vector<SiteTree::Entry> items;
  items.reserve(boundary.sites.size());
  for (std::size_t k = 0; k < boundary.sites.size(); ++k)
    items.push_back({boundary.sites[k].position, static_cast<LocalIndex>(k)});
  return SiteTree(std::move(items));
}

} // namespace

std::vector<ShortEdge> short_edges(const comm::Communicator& comm, const polygon::BoundarySites& boundary,
                                   double shortest) {
  const SiteTree tree = tree_of(boundary);
  return comm::gather_shared<ShortEdge>(
      comm, std::ssize(boundary.sites), sites_in_a_row, [&](std::ptrdiff_t item, std::vector<ShortEdge>& list) {
        const auto k = static_cast<LocalIndex>(item);
        const geometry::Segment chord = boundary.chord(k);
        if (const double length = geometry::length(chord.b - chord.a); length < shortest)
          list.push_back({boundary.periods.wrap(0.5 * (chord.a + chord.b)), length});
        tree.for_each_within(chord.a, shortest, [&](const SiteTree::Entry& other) {
          if (other.index > k && other.index != boundary.sites[k].next && other.index != boundary.sites[k].previous)
            list.push_back({0.5 * (chord.a + other.position), geometry::length(other.position - chord.a)});
        });
      });
}

} // namespace trime::boundary
