// SPDX-License-Identifier: BSD-3-Clause
// Reads the shape of a config: its parts, its container and its region.
#pragma once

#include "config_text.hpp"
#include "curve.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace trime_check {

struct Part {
  std::string name;
  std::unique_ptr<Curve> curve; ///< empty for a formula, or for a kind of file that trime_check cannot read
  std::string reason;           ///< why there is no curve
  double bend = 0;              ///< the boundary may be so far from the curve, because edges of maps are curves
  /// Vertices where edges of united polygons cross. The mesher, which crosses their edges in the plane, may have
  /// others.
  std::vector<Point> crossings = {};
  bool has_names = false; ///< whether its file can give names or markers to pieces of the curve

  bool is_crossing(Point p) const {
    return std::any_of(crossings.begin(), crossings.end(), [p](Point q) { return p.x == q.x && p.y == q.y; });
  }
};

/// Finds the parts near a place.
class PartFinder {
public:
  explicit PartFinder(const std::vector<Part>& parts);
  ~PartFinder();
  /// Returns the numbers of the parts with curves whose boxes come within `reach` of p.
  std::vector<std::size_t> near(Point p, double reach) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// @brief The parts of a config in its container. The part `domain`, which is the container itself, is the last.
struct Shape {
  std::vector<Part> parts;
  PartNumbers numbers; ///< numbers of the parts, by name
  std::unique_ptr<PartFinder> finder;
  std::unique_ptr<Region> region;
  Box container;
  std::string
      container_reason; ///< why the container is not known; in that case `container` is the bounding box of the mesh
  Periods periods;
  double step = 0; ///< step of the coordinate lattice: all coordinates of the mesh are multiples of it
  std::vector<Point> fixed_points;
  std::string fixed_points_reason; ///< why the fixed points are not known

  double side() const { return std::fmax(container.max.x - container.min.x, container.max.y - container.min.y); }
  /// @brief Returns the part to which a label of a mesh file belongs. A label is the name of a part, or the name of a
  /// contour followed by a point and a name or marker of its features. Returns null if
  /// no part has that name.
  const Part* part_of_label(const std::string& label) const;
  /// Returns whether the region contains this part.
  bool is_used(const Part& part) const { return region->uses(static_cast<std::size_t>(&part - parts.data())); }
  /// Returns the distance of p from the curve of a part, including its periodic images.
  double distance(const Part& part, Point p) const;
  /// Returns the distance from the nearest part that the region uses if it is at most `limit`, otherwise a larger
  /// number.
  double distance_from_any(Point p, double limit) const;
  /// Returns whether p lies in the shape. @pre all parts of the region have curves
  bool contains(Point p) const;
  /// Returns whether the curve of another part of the region, or a periodic image of this curve, passes within `limit`
  /// of p. If so, a corner of this part at p need not be a corner of the shape.
  bool meets_another(const Part& part, Point p, double limit) const;
  /// Returns whether p would change between inside and outside of the shape if it entered or left this part. @pre all
  /// parts have curves
  bool matters(const Part& part, Point p) const;

  /// Returns the image of p in the container, followed by its other periodic images, because a part may extend beyond
  /// the container.
  std::vector<Point> images(Point p) const;

private:
  const Part* part(const std::string& name) const;
};

/// @param mesh points of the mesh; their bounding box replaces a container that depends on files that trime_check
/// cannot read
/// @param plane reference system of the mesh, into which contours are projected if the config says so
/// @throws Failure (exit 2) if the config is incomplete
Shape make_shape(const ConfigText& config, const std::vector<Point>& mesh, const std::string& plane);

} // namespace trime_check
