// SPDX-License-Identifier: BSD-3-Clause
// Finds the places from which a size must be limited so that it grows by no more than a given gradation per length.
#pragma once

#include "sizing/lowered_size.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/segment_grid.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace trime::sizing {

/// @brief Limits the growth of a size field. The largest size below h that grows by at most K per length is the minimum
/// over all places y of h(y) + K |x - y|. Only places y at the lower edge of a steep part of h matter: at all others, h
/// itself is the minimum. This class samples h on a grid over the shape with one random place in each cell, begins
/// where two neighbouring samples differ too much, and follows the lower edge of each steep part from there. So it
/// finds a band of small sizes that is far narrower than the cells, if one sample lies in it. Sizes that grow too fast
/// with the distance from the boundary are limited from places along the boundary, which need no search. (Persson,
/// "Mesh size functions for implicit geometries and PDE-based gradient limiting", 2006, solves the same problem on a
/// whole grid.)
class SteepSizes {
public:
  /// Samples the field; ranks and threads share the work. Cost: one evaluation of the field for each sample.
  /// Collective.
  /// @param relative the field; invalid sizes are skipped, as they may lie outside of the shape
  /// @param samples about the number of samples, in the box around the boundary
  /// @throws what the field throws, on all ranks together
  /// @pre all references outlive this object
  SteepSizes(const comm::Communicator& comm, const SizeField& relative, const geometry::Boundary& boundary,
             const geometry::Lattice& lattice, double samples);

  /// A place from which the size must be limited, and how steep the size is there.
  struct Steepest {
    geometry::Vec2 place;
    double slope;
  };
  struct Limits {
    double gradation = 0;          ///< growth from these places: a little less than what is allowed
    std::vector<SizeLimit> limits; ///< places and sizes; empty if the size is nowhere too steep
    Steepest steepest{{}, 0};      ///< steepest pair of neighbouring samples in the shape
    bool is_full = false;          ///< true if there are more than the allowed number of places; some are missing
    bool is_capped = false;        ///< true if the search has ended at its largest number of places; some are missing
  };
  /// @brief Returns the limits for a size; the same bits for any number of ranks and threads. Collective. Cost: about
  /// 200 evaluations of the field for each limit; there is about one limit for each 0.35 h along the edges of steep
  /// parts, and at most SizingRules::most_places_searched. Each rank follows all edges.
  /// @throws what the field throws, on all ranks together
  /// @param asked the field times a factor
  /// @param most_places number of places at which the search ends, because a mesh with that size would have too many
  /// points
  Limits limits(const ScaledSize& asked, double gradation, double most_places);

private:
  struct Sample {
    geometry::Vec2 place;
    double relative;
  };
  class Front;
  /// A sample from which the size grows too fast towards a neighbouring sample.
  struct Seed {
    geometry::Vec2 low, high;
    double size;  ///< at `low`
    double slope; ///< growth of the size between both places
  };
  geometry::Vec2 place_in(int i, int j) const;
  std::optional<Seed> seed_at(int i, int j, const ScaledSize& asked, double gradation) const;
  std::vector<Seed> seeds(const ScaledSize& asked, double gradation) const;
  bool inside(geometry::Vec2 p) const;
  std::vector<SizeLimit> along_boundary(const ScaledSize& asked, double gradation, double most_places) const;

  const comm::Communicator& comm_;
  const SizeField& relative_;
  const geometry::Boundary& boundary_;
  const geometry::Lattice& lattice_;
  int columns_ = 0, rows_ = 0;
  geometry::Box box_;
  int first_row_ = 0, last_row_ = 0;                // the rows of this rank, and one more on each side
  std::vector<Sample> samples_;                     // samples of these rows, row by row
  std::optional<geometry::SegmentGrid> segments_{}; // chords of the boundary; made when a steep place was found
};

} // namespace trime::sizing
