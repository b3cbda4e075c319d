// SPDX-License-Identifier: BSD-3-Clause
// The shape of a config: its parts, container and region.
#pragma once

#include "config_text.hpp"
#include "curve.hpp"

#include <memory>
#include <string>
#include <vector>

namespace trime_check {

struct Part {
  std::string name;
  std::unique_ptr<Curve> curve; ///< none: a formula, or a file that is not read
  std::string reason;           ///< why there is no shape
};

/// Finds the parts near a place.
class PartFinder {
public:
  explicit PartFinder(const std::vector<Part>& parts);
  ~PartFinder();
  /// Numbers of the parts with curves whose boxes come within `reach` of p.
  std::vector<std::size_t> near(Point p, double reach) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// @brief The parts of a config in its container, `domain` behind the others.
struct Shape {
  std::vector<Part> parts;
  PartNumbers numbers; ///< of the parts, by name
  std::unique_ptr<PartFinder> finder;
  std::unique_ptr<Region> region;
  Box container;
  std::string container_reason; ///< why it is not known; then `container` is the box of the mesh
  Periods periods;
  double step = 0; ///< of the lattice on which all coordinates lie
  std::vector<Point> fixed_points;
  std::string fixed_points_reason; ///< why they are not known

  double side() const { return std::fmax(container.max.x - container.min.x, container.max.y - container.min.y); }
  /// @brief Returns the part with the name in a mesh file: the part with this name, or a contour that is not read here,
  /// followed by a point and a name or marker of its features. Null if no part fits.
  const Part* part_of_label(const std::string& label) const;
  /// Does the region name it?
  bool is_used(const Part& part) const { return region->uses(static_cast<std::size_t>(&part - parts.data())); }
  /// Distance from a part, images of the container's periods too.
  double distance(const Part& part, Point p) const;
  /// Distance from the nearest part of the region, if it is no more than `limit`; else something above it.
  double distance_from_any(Point p, double limit) const;
  /// Does p lie in the shape? @pre all parts of the region have curves
  bool contains(Point p) const;
  /// Does the curve of another part of the region, or an image of this one, pass within `limit` of p? Then a corner of
  /// this part need not be one of the shape.
  bool meets_another(const Part& part, Point p, double limit) const;
  /// Does the shape change at p where one is in this part or out of it? @pre all parts have curves
  bool matters(const Part& part, Point p) const;

  /// Images of p in the container (the first one), and wherever parts that stick out of it may be.
  std::vector<Point> images(Point p) const;

private:
  const Part* part(const std::string& name) const;
};

/// @param mesh its points: their box stands for a container that follows from files that are not read here
/// @throws Failure (exit 2) where the config says too little
Shape make_shape(const ConfigText& config, const std::vector<Point>& mesh);

} // namespace trime_check
