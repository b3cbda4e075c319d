// SPDX-License-Identifier: BSD-3-Clause
// The shape that is meshed: parts joined by a region expression, its exact boundary, inside test and distance. The
// expression is that of the config key `geometry`:
//   expression = name | union(e, e, ...) | intersection(e, e, ...) | difference(e, e, ...)
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/shape/part.hpp"
#include "trime/tracing/shape.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trime::shape {

/// Name that stands for the container itself; no part may have it.
inline constexpr std::string_view domain_name = "domain";

/// A parsed expression over parts that are known by their index. Immutable.
class Region {
public:
  static constexpr int max_depth = 64; ///< largest depth of nested operations

  /// @brief Parses `text`; leaves refer to `part_names` by index, `domain` to the index part_names.size().
  /// @throws ConfigError with the position, or with the known names and the nearest one
  static Region parse(std::string_view text, std::span<const std::string> part_names);

  const std::string& text() const { return text_; }
  /// The indices of the parts that occur, ascending, each once.
  const std::vector<int>& parts() const { return parts_; }

  /// @brief Does the shape contain a point? inside(part index) must say whether the point lies in a part; it is called
  /// only as often as needed.
  template <class Inside>
  bool contains(const Inside& inside) const {
    return value(0, inside);
  }

  /// Returns whether a part occurs only as something that is subtracted.
  bool subtracts(int part) const { return subtracts(0, part, false) && !subtracts(0, part, true); }

  /// Returns a box around the shape, from the boxes of all parts and, after them, of the domain.
  geometry::Box box(std::span<const geometry::Box> boxes) const { return box_of(0, boxes); }

private:
  friend class RegionState;
  enum class Operation { part, unite, intersect, subtract };
  struct Node {
    Operation operation;
    int part;                  ///< leaves only
    std::vector<int> operands; ///< indices into nodes_
  };
  class Parser;

  template <class Inside>
  bool value(int node, const Inside& inside) const {
    const Node& n = nodes_[node];
    if (n.operation == Operation::part)
      return inside(n.part);
    // An operation is decided by the first operand with the deciding value; subtraction negates all but the first.
    const bool decides = n.operation == Operation::unite;
    for (std::size_t k = 0; k < n.operands.size(); ++k) {
      const bool negated = n.operation == Operation::subtract && k > 0;
      if ((value(n.operands[k], inside) != negated) == decides)
        return decides;
    }
    return !decides;
  }

  /// Returns whether the part occurs below the node with an even number of subtractions in between, or an odd one.
  bool subtracts(int node, int part, bool even) const;
  geometry::Box box_of(std::size_t node, std::span<const geometry::Box> boxes) const;

  std::string text_;
  std::vector<Node> nodes_; // the root first
  std::vector<int> parts_;
};

/// Parts joined by a region. Its geometry does not change after construction; all queries are thread-safe.
class RegionShape final : public tracing::Shape {
public:
  /// @brief Parses the region and makes the boundary.
  /// @param parts parts with different names, without the name `domain`; see Region::parse for `region`
  /// @throws ConfigError for the region, or for names. GeometryError if the region is empty, leaves the container or
  /// has a boundary that touches itself. Also if a part sticks out of a periodic side by more than one period, or was
  /// made in another frame whose lattice or place does not fit this one.
  RegionShape(std::vector<Part> parts, std::string_view region, const geometry::Frame& frame);

  /// The input of the mesher.
  const geometry::Domain& domain() const { return domain_; }
  const geometry::Frame& frame() const { return domain_.frame(); }
  const geometry::Boundary& boundary() const { return domain_.boundary(); }
  /// Points that meshes of this shape keep, see Domain::fixed_points. They are not part of the shape.
  void set_fixed_points(std::vector<geometry::FixedPoint> points) { domain_.set_fixed_points(std::move(points)); }
  /// The given parts, then the container under the name `domain`.
  const std::vector<Part>& parts() const { return parts_; }
  const Region& region() const { return region_; }

  /// @brief Returns whether p lies inside. Exact for lattice points; a point on the boundary may get either answer.
  bool inside(geometry::Vec2 p) const;
  /// @brief Returns the distance to the nearest point of the boundary, to within rounding.
  double distance_to_boundary(geometry::Vec2 p) const { return tree_.distance(p); }
  /// Negative inside.
  double signed_distance(geometry::Vec2 p) const override {
    return inside(p) ? -distance_to_boundary(p) : distance_to_boundary(p);
  }

private:
  std::vector<Part> parts_;
  std::vector<std::vector<geometry::Vec2>> shifts_; // shifts of the images of each part
  Region region_;
  geometry::Domain domain_;
  geometry::PieceTree tree_;
};

/// @brief Makes only the domain, for callers that need nothing else of the shape: frees the parts and everything that
/// was built to find the boundary. The domain has the same bits as that of a RegionShape.
/// @throws ConfigError, GeometryError as RegionShape
geometry::Domain domain_of(std::vector<Part> parts, std::string_view region, const geometry::Frame& frame);

/// @brief Traces your own shape: returns the region that consists of it alone. See traced_part for cost and errors.
RegionShape traced(const tracing::Shape& shape, const geometry::Frame& frame, const std::string& name = "shape");

} // namespace trime::shape
