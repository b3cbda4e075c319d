// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/facet_cycles.hpp"

#include "core/random.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace trime::certificate {
namespace {

/// Facets that follow on each other, all through regular points.
struct Link {
  GlobalId entry;   ///< where the first one starts
  GlobalId exit;    ///< where the last one ends
  GlobalId least;   ///< of the points where they start
  std::int64_t tag; ///< of the facet that starts at the least
};
using Links = std::vector<Link>; // by entry

/// Equal shares of the ids, in the order of ranks.
class IdOwners {
public:
  IdOwners(GlobalId points, int ranks) : share_(std::max<GlobalId>(1, (points + ranks - 1) / ranks)), ranks_(ranks) {}
  int operator()(GlobalId id) const { return static_cast<int>(std::clamp<GlobalId>(id / share_, 0, ranks_ - 1)); }

private:
  GlobalId share_;
  int ranks_;
};

/// Each facet at the owners of both of its ends. Collective.
std::vector<TaggedFacet> at_owners(std::span<const TaggedFacet> facets, const IdOwners& owner,
                                   const comm::Communicator& comm) {
  std::map<int, std::vector<TaggedFacet>> parcels;
  for (const TaggedFacet& facet : facets) {
    parcels[owner(facet.first)].push_back(facet);
    if (owner(facet.second) != owner(facet.first))
      parcels[owner(facet.second)].push_back(facet);
  }
  std::vector<TaggedFacet> arrived = std::move(parcels[comm.rank()]);
  parcels.erase(comm.rank());
  std::vector<comm::Message> outgoing;
  for (const auto& [peer, parcel] : parcels)
    outgoing.push_back({peer, comm::to_bytes<TaggedFacet>(parcel)});
  for (const comm::Message& message : comm.exchange_any(outgoing)) {
    const auto part = comm::from_bytes<TaggedFacet>(message.data);
    arrived.insert(arrived.end(), part.begin(), part.end());
  }
  return arrived;
}

/// The facets that start at regular points of this rank, each a link. Counts what is irregular, and changes of tags.
Links links_of(const std::vector<TaggedFacet>& facets, const IdOwners& owner, int rank, CycleCounts& counts) {
  std::vector<TaggedFacet> out, in;
  for (const TaggedFacet& facet : facets) {
    if (owner(facet.first) == rank)
      out.push_back(facet);
    if (owner(facet.second) == rank)
      in.push_back(facet);
  }
  std::sort(out.begin(), out.end(), [](const TaggedFacet& a, const TaggedFacet& b) { return a.first < b.first; });
  std::sort(in.begin(), in.end(), [](const TaggedFacet& a, const TaggedFacet& b) { return a.second < b.second; });
  Links links;
  std::size_t i = 0, o = 0;
  while (i < in.size() || o < out.size()) {
    const GlobalId id = i == in.size()    ? out[o].first
                        : o == out.size() ? in[i].second
                                          : std::min(in[i].second, out[o].first);
    const std::size_t first_in = i, first_out = o;
    while (i < in.size() && in[i].second == id)
      ++i;
    while (o < out.size() && out[o].first == id)
      ++o;
    if (i - first_in == 1 && o - first_out == 1) {
      counts.changes += in[first_in].tag != out[first_out].tag;
      links.push_back({id, out[first_out].second, id, out[first_out].tag});
    } else {
      ++counts.irregular;
    }
  }
  return links;
}

void append(Link& link, const Link& next) {
  link.exit = next.exit;
  if (next.least < link.least) {
    link.least = next.least;
    link.tag = next.tag;
  }
}

/// Joins links that follow on each other; what closes is counted and gone. No two links have the same entry, nor the
/// entry of a third as their exit: such points are not regular.
Links joined(const Links& links, CycleCounts& counts) {
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> next(links.size(), none);
  std::vector<bool> is_next(links.size(), false), seen(links.size(), false);
  for (std::size_t k = 0; k < links.size(); ++k) {
    const auto found = std::lower_bound(links.begin(), links.end(), links[k].exit,
                                        [](const Link& link, GlobalId id) { return link.entry < id; });
    if (found == links.end() || found->entry != links[k].exit)
      continue;
    next[k] = static_cast<std::size_t>(found - links.begin());
    is_next[next[k]] = true;
  }
  const auto follow = [&](std::size_t first) {
    Link whole = links[first];
    seen[first] = true;
    for (std::size_t k = next[first]; k != none && !seen[k]; k = next[k]) {
      append(whole, links[k]);
      seen[k] = true;
    }
    return whole;
  };
  Links open;
  for (std::size_t k = 0; k < links.size(); ++k)
    if (!is_next[k])
      open.push_back(follow(k));
  for (std::size_t k = 0; k < links.size(); ++k)
    if (!seen[k]) {
      ++counts.cycles;
      counts.tags += tag_hash(follow(k).tag);
    }
  return open;
}

void send(const Links& links, int peer, const comm::Communicator& comm) {
  const std::array<std::int64_t, 1> size{std::ssize(links)};
  for (std::vector<std::byte> bytes : {comm::to_bytes<std::int64_t>(size), comm::to_bytes<Link>(links)}) {
    const comm::Message message{peer, std::move(bytes)};
    comm.exchange_known(std::span(&message, 1), {});
  }
}

Links receive(int peer, const comm::Communicator& comm) {
  comm::Message size{peer, std::vector<std::byte>(sizeof(std::int64_t))};
  comm.exchange_known({}, std::span(&size, 1));
  const auto count = static_cast<std::size_t>(comm::from_bytes<std::int64_t>(size.data).front());
  comm::Message links{peer, std::vector<std::byte>(count * sizeof(Link))};
  comm.exchange_known({}, std::span(&links, 1));
  return comm::from_bytes<Link>(links.data);
}

} // namespace

std::uint64_t tag_hash(std::int64_t tag) {
  return mix_bits(static_cast<std::uint64_t>(tag) + 1);
}

CycleCounts count_cycles(std::span<const TaggedFacet> facets, GlobalId points, const comm::Communicator& comm) {
  CycleCounts counts;
  const IdOwners owner(points, comm.size());
  Links links = joined(links_of(at_owners(facets, owner, comm), owner, comm.rank(), counts), counts);
  for (int step = 1; step < comm.size(); step *= 2) { // of the ranks that are left every second one hands on its links
    if (comm.rank() / step % 2 == 1) {
      send(links, comm.rank() - step, comm);
      break;
    }
    if (comm.size() - comm.rank() > step) {
      const Links higher = receive(comm.rank() + step, comm);
      links.insert(links.end(), higher.begin(), higher.end());
      links = joined(links, counts);
    }
  }
  return counts;
}

} // namespace trime::certificate
