// SPDX-License-Identifier: BSD-3-Clause
// Ghost sites. Each rank subscribes to bins of foreign tiles and, in a periodic container, to images of bins, also of
// bins that it owns. Their owners send the sites of these bins at every refresh; the receivers move them to their
// images. Subscriptions persist and grow on request. This file knows nothing of triangles.
//
// Words, seen from this rank: it *imports* the bins that it subscribes to and *exports* those that others subscribe to.
// An owned site in an exported bin is a *mirror*, its copy elsewhere a *ghost*.
#pragma once

#include "decomposition/partition.hpp"
#include "mesh/binned_points.hpp"
#include "trime/comm/communicator.hpp"

#include <vector>

namespace trime::decomposition {

/// A message about a ghost to its owner. It names the ghost, and the site that causes the message, by their present
/// places.
struct GhostNews {
  geometry::Vec2 ghost, cause;
};

class Halo {
public:
  /// @pre both arguments outlive this object
  Halo(const comm::Communicator& comm, const mesh::TileGrid& grid);

  /// @brief Drops all subscriptions, and subscribes to all foreign bins and images within `margin` bins of an owned
  /// tile. Collective.
  void reset(const Partition& partition, int margin);

  /// @brief Fetches the sites of all subscribed bins and puts them into `points` as ghosts. Collective among neighbours
  /// only. Two messages per neighbour: site counts per bin, then the sites (24 bytes each).
  void refresh(mesh::BinnedPoints& points);

  /// @brief Subscribes to more bins, fetches their sites at their present places with their sizes, and adds them behind
  /// the other ghosts. Collective. Only ranks that ask, and their owners, exchange data.
  /// @param missing bins of foreign tiles or of images that are not known; the same one may be in the list twice
  /// @param sizes null, or h by local index; gets the h of the new ghosts
  void extend(mesh::BinnedPoints& points, std::vector<mesh::BinRef> missing, std::vector<double>* sizes);

  /// @brief Fetches the positions of the ghosts again, after their owners moved them without sorting, and the drift of
  /// their tiles (see BinnedPoints). Sends one message per neighbour, 16 bytes per ghost and 8 per tile. Ghosts must
  /// not be read between begin_positions and finish_positions. Collective among neighbours only. @pre no periods
  void begin_positions(const mesh::BinnedPoints& points);
  void finish_positions(mesh::BinnedPoints& points);

  /// @brief Sends the values of owned sites to all ranks that have ghosts of them. Returns the values of the ghosts, in
  /// their order. @pre no site has changed since refresh was called. Collective among neighbours only.
  std::vector<GlobalId> exchange(const mesh::BinnedPoints& points, std::span<const GlobalId> owned_values) const;
  std::vector<double> exchange(const mesh::BinnedPoints& points, std::span<const double> owned_values) const;

  /// @brief Sends messages about ghosts to their owners. Two ranks exchange a message if one has ghosts of the other.
  /// Collective among neighbours only.
  /// @param ghosts local index of the ghost for each of `news`
  /// @return the messages of other ranks about sites of this rank
  std::vector<GhostNews> tell_owners(const mesh::BinnedPoints& points, std::span<const LocalIndex> ghosts,
                                     std::span<const GhostNews> news) const;

private:
  struct Peer {
    int rank;
    std::vector<mesh::BinRef> bins; // ascending
  };
  /// The local indices of the sites of all bins of a peer. They are valid until sites are sorted or the halo grows.
  struct Route {
    int rank;
    std::vector<mesh::SiteRange> ranges;
    std::vector<LocalIndex> tiles; // known tiles to which these bins belong
    std::size_t site_count;
  };
  static Route route_of(const mesh::BinnedPoints& points, const Peer& peer, bool exported);
  void find_routes(const mesh::BinnedPoints& points);
  template <class T>
  std::vector<T> exchange_values(const mesh::BinnedPoints& points, std::span<const T> owned_values) const;
  void list_bins_around(LocalIndex tile, int margin, std::vector<mesh::BinRef>& wanted) const;
  std::vector<Peer> by_owner(std::vector<mesh::BinRef> bins) const;
  std::vector<int> peers() const;
  std::vector<Peer> subscribe(const std::vector<Peer>& requests);

  const comm::Communicator* comm_;
  const mesh::TileGrid* grid_;
  Partition partition_;
  std::vector<Peer> imports_, exports_;  // ascending by rank
  std::vector<Route> inward_, outward_;  // routes of the imports and of the exports
  std::vector<comm::Message> positions_; // messages on their way, one per import
  comm::Communicator::Exchange exchange_;
};

} // namespace trime::decomposition
