// SPDX-License-Identifier: BSD-3-Clause
// A size field that is bounded in some regions of a shape, such as a material that needs small triangles.
#pragma once

#include "geometry/periodic_outline.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/segment_grid.hpp"
#include "trime/sizing/size_field.hpp"

#include <limits>
#include <span>
#include <vector>

namespace trime::sizing {

/// The largest size in a region.
struct RegionBound {
  int region; ///< index into geometry::Regions::names
  double size;
};

/// @brief The size of a field, but at most the bound of the region in which a place lies. It jumps at the border of the
/// region, which has the smaller size; the mesher then limits its growth, see SteepSizes. Arcs count as polygons with
/// sides of at most one degree.
class RegionSize final : public SizeField {
public:
  /// @pre `field` outlives this object
  /// Cost: O(n log n) for n pieces around the regions.
  RegionSize(const SizeField& field, const geometry::Domain& domain, std::vector<RegionBound> bounds);
  /// Returns the size at p. An invalid size of the field is returned unchanged. Cost: one inside test for each bound.
  double size(geometry::Vec2 p) const override { return bounded(p, field_.size(p)); }
  void sizes(std::span<const geometry::Vec2> places, std::span<double> values) const override;
  bool prefers_blocks() const override { return field_.prefers_blocks(); }
  bool jumps() const override { return true; }
  std::size_t memory_bytes() const override;

private:
  double bounded(geometry::Vec2 p, double size) const;

  struct Bounded {
    geometry::Box box;
    geometry::SegmentGrid outline;
    double size;
    double border; ///< places outside, but within this distance, belong to the region
  };
  struct PeriodicBound {
    geometry::PeriodicOutline outline;
    double size, border;
  };
  const SizeField& field_;
  geometry::Lattice lattice_;
  geometry::Periods periods_;
  std::vector<Bounded> bounded_;
  std::vector<PeriodicBound> periodic_;                    // in a periodic container instead
  double whole_ = std::numeric_limits<double>::infinity(); // bound of a region that fills such a container
};

} // namespace trime::sizing
