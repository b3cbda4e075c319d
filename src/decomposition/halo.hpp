// SPDX-License-Identifier: BSD-3-Clause
// Manages ghost sites. Each rank subscribes to bins of foreign tiles; in a periodic container also to periodic images
// of bins, including bins that it owns. The owners send the sites of these bins at every refresh, and the receivers
// shift the sites to their images. Subscriptions stay until reset, and grow on request. This file does not use
// triangles.
//
// Words, seen from one rank: it *imports* the bins to which it subscribes, and *exports* the bins to which others
// subscribe. An owned site in an exported bin is a *mirror*; the copy of it on another rank is a *ghost*.
#pragma once

#include "decomposition/partition.hpp"
#include "mesh/binned_points.hpp"
#include "trime/comm/communicator.hpp"

#include <vector>

namespace trime::decomposition {

/// A message about a ghost to its owner. The message identifies the ghost, and the site that caused the message, by
/// their present places.
struct GhostNews {
  geometry::Vec2 ghost, cause;
};

class Halo {
public:
  /// Begins without subscriptions.
  /// @pre both arguments outlive this object
  Halo(const comm::Communicator& comm, const mesh::TileGrid& grid);

  /// @brief Drops all subscriptions, and subscribes to all foreign bins and periodic images of bins within `margin`
  /// bins of an owned tile. Collective.
  void reset(const Partition& partition, int margin);

  /// @brief Fetches the sites of all subscribed bins and stores them in `points` as ghosts. Sends two messages to each
  /// neighbour: the number of sites in each bin, then the sites (24 bytes each). Collective among neighbours only.
  void refresh(mesh::BinnedPoints& points);

  /// @brief Subscribes to more bins, fetches their sites at their present places with their sizes, and appends them to
  /// the other ghosts. Collective. Only ranks that need bins, and the owners of these bins, exchange data.
  /// @param missing bins of foreign tiles or of periodic images that are not known; a bin may occur twice
  /// @param sizes the target edge length h by local index, which receives the h of the new ghosts; may be null
  void extend(mesh::BinnedPoints& points, std::vector<mesh::BinRef> missing, std::vector<double>* sizes);

  /// @brief Fetches the positions of the ghosts again after their owners moved them without sorting, and the drift of
  /// their tiles (see BinnedPoints). Sends one message to each neighbour, with 16 bytes per ghost and 8 per tile.
  /// Ghosts must not be read between begin_positions and finish_positions. Collective among neighbours only.
  /// @pre the container is not periodic
  void begin_positions(const mesh::BinnedPoints& points);
  void finish_positions(mesh::BinnedPoints& points);

  /// @brief Sends the values of owned sites to all ranks that have ghosts of these sites. Returns the values of this
  /// rank's ghosts, in their order.
  /// @pre no site has changed since refresh was called. Collective among neighbours only.
  std::vector<GlobalId> exchange(const mesh::BinnedPoints& points, std::span<const GlobalId> owned_values) const;
  std::vector<double> exchange(const mesh::BinnedPoints& points, std::span<const double> owned_values) const;

  /// @brief Sends messages about ghosts to their owners. Two ranks exchange a message if one has ghosts of the other's
  /// sites. Collective among neighbours only.
  /// @param ghosts local index of the ghost for each message in `news`
  /// @return the messages of other ranks about sites of this rank
  std::vector<GhostNews> tell_owners(const mesh::BinnedPoints& points, std::span<const LocalIndex> ghosts,
                                     std::span<const GhostNews> news) const;

private:
  struct Peer {
    int rank;
    std::vector<mesh::BinRef> bins; // ascending
  };
  /// The local indices of the sites in all bins of a neighbour. The indices are valid until sites are sorted or the
  /// halo grows.
  struct Route {
    int rank;
    std::vector<mesh::SiteRange> ranges;
    std::vector<LocalIndex> tiles; // known tiles to which the bins belong
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
  std::vector<Route> inward_, outward_;  // the routes of imports_ and of exports_
  std::vector<comm::Message> positions_; // messages that are being exchanged, one for each import
  comm::Communicator::Exchange exchange_;
};

} // namespace trime::decomposition
