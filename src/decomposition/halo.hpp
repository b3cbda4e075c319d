// SPDX-License-Identifier: BSD-3-Clause
// Ghost sites: each rank subscribes to bins of foreign tiles, and in a periodic container to images of bins, its own
// among them. Their owners send the sites of these bins at every refresh; the receivers move them to their images.
// Subscriptions persist and grow on request. Knows nothing of triangles.
//
// Words, seen from this rank: it *imports* the bins that it subscribes to and *exports* those that others subscribe to.
// An owned site in an exported bin is a *mirror*, its copy elsewhere a *ghost*.
#pragma once

#include "decomposition/partition.hpp"
#include "mesh/binned_points.hpp"
#include "trime/comm/communicator.hpp"

#include <vector>

namespace trime::decomposition {

class Halo {
public:
  /// @pre both outlive this object
  Halo(const comm::Communicator& comm, const mesh::TileGrid& grid);

  /// @brief Starts anew for a partition: subscribes to all foreign bins and images within `margin` bins of an owned
  /// tile. Collective.
  void reset(const Partition& partition, int margin);

  /// @brief Adds `bins` (of foreign tiles or of images) to the subscriptions of this rank. Collective; ranks may ask
  /// for nothing.
  void subscribe(std::span<const mesh::BinRef> bins);

  /// @brief Fetches the sites of all subscribed bins and puts them into `points` as ghosts. Collective among neighbours
  /// only. Two messages per neighbour: site counts per bin, then the sites (24 bytes each).
  void refresh(mesh::BinnedPoints& points);

  /// @brief Fetches the positions of the ghosts anew, after their owners moved them without sorting, and the drift
  /// of their tiles (see BinnedPoints). One message per neighbour, 16 bytes a ghost and 8 a tile. In two parts: between
  /// them ghosts must not be looked at. Collective among neighbours only. @pre no periods
  void begin_positions(const mesh::BinnedPoints& points);
  void finish_positions(mesh::BinnedPoints& points);

  /// @brief Fetches the drift of the tiles with imported bins from their owners, after a growth of the subscriptions.
  /// One message per neighbour. Collective among neighbours only. @pre no periods
  void refresh_drifts(mesh::BinnedPoints& points) const;

  /// @brief New local index by old index - owned for the ghosts of the last refresh, after a growth of the
  /// subscriptions with unchanged sites. Valid until the next refresh.
  std::span<const LocalIndex> ghost_renumbering() const { return ghost_renumbering_; }

  /// @brief The values of all ghosts, in ghost order, from the values of the owned sites. @pre refresh was called and
  /// no site has changed since. Collective among neighbours only.
  std::vector<GlobalId> exchange(const mesh::BinnedPoints& points, std::span<const GlobalId> owned_values) const;
  std::vector<double> exchange(const mesh::BinnedPoints& points, std::span<const double> owned_values) const;

private:
  struct Peer {
    int rank;
    std::vector<mesh::BinRef> bins; // ascending
  };
  template <class T>
  std::vector<T> exchange_values(const mesh::BinnedPoints& points, std::span<const T> owned_values) const;
  std::size_t ghosts_of(const mesh::BinnedPoints& points, const Peer& peer) const;
  static bool begins_tile(const Peer& peer, std::size_t k);
  void list_bins_around(LocalIndex tile, int margin, std::vector<mesh::BinRef>& wanted) const;
  void note_renumbering(LocalIndex owned, std::span<const std::int32_t> new_counts);

  const comm::Communicator* comm_;
  const mesh::TileGrid* grid_;
  Partition partition_;
  std::vector<Peer> imports_, exports_; // ascending by rank
  std::vector<mesh::BinRef> imported_;  // all of imports_: ascending, because ranks own ascending tiles
  std::vector<std::int32_t> counts_;    // ghosts per imported bin at the last refresh
  std::vector<mesh::BinRef> refreshed_; // imported bins at the last refresh
  std::vector<LocalIndex> ghost_renumbering_;
  std::vector<comm::Message> positions_; // on their way, one message per import
  comm::Communicator::Exchange exchange_;
};

} // namespace trime::decomposition
