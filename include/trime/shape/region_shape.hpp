// SPDX-License-Identifier: BSD-3-Clause
// The shape that is meshed: parts joined by an expression, with its exact boundary, inside test and distance. The
// config key `geometry` has this expression as its value:
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

/// The name of the container in expressions; no part may have this name.
inline constexpr std::string_view domain_name = "domain";

/// A parsed expression over parts, which are stored as indices. Immutable.
class Region {
public:
  static constexpr int max_depth = 64; ///< largest depth to which operations may be nested

  /// @brief Parses `text`. The names in it become indices into `part_names`; `domain` becomes part_names.size().
  /// @throws ConfigError with the position of a syntax error, or, for an unknown name, with the known names and the
  /// most similar one
  static Region parse(std::string_view text, std::span<const std::string> part_names);
  /// Returns the expression that consists of one part alone.
  static Region of_part(int part, std::string_view text);

  const std::string& text() const { return text_; }
  /// Returns the indices of the parts that occur in the expression, ascending, each once.
  const std::vector<int>& parts() const { return parts_; }

  /// @brief Returns whether the shape contains a point. inside(part index) must return whether the point lies in a
  /// part; it is called only as often as needed.
  template <class Inside>
  bool contains(const Inside& inside) const {
    return value(0, inside);
  }

  /// Returns whether a part occurs only as something that is subtracted.
  bool subtracts(int part) const { return subtracts(0, part, false) && !subtracts(0, part, true); }

  /// Returns a box around the shape, computed from the boxes of all parts and, as the last element, of the domain.
  geometry::Box box(std::span<const geometry::Box> boxes) const { return box_of(0, boxes); }

private:
  friend class RegionState;
  enum class Operation { part, unite, intersect, subtract };
  struct Node {
    Operation operation;       ///< index of the part; used in leaves only
    int part;                  ///< leaves only
    std::vector<int> operands; ///< indices into nodes_
  };
  class Parser;

  template <class Inside>
  bool value(int node, const Inside& inside) const {
    const Node& n = nodes_[node];
    if (n.operation == Operation::part)
      return inside(n.part);
    // A union is decided by the first operand that contains the point, an intersection by the first that does not. A
    // difference is the intersection of the first operand with the complements of the others.
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

/// A region of a shape, such as a material.
struct NamedRegion {
  std::string name;
  std::string geometry; ///< an expression over the same parts as the geometry of the shape, see Region::parse
  int part = -1; ///< index into Division::parts of the part that is the region, instead of an expression; -1: none
};

/// @brief Says how a shape is divided into regions. A place belongs to the first region that contains it; a place in
/// none of them belongs to the rest.
struct Division {
  std::vector<NamedRegion> regions{};
  std::vector<Part> parts{};  ///< regions that a part gives instead of an expression, such as polygons of a map
  std::string rest{};         ///< name of the rest; empty: the text of the geometry
  bool cover_all = false;     ///< whether a rest with an area is an error
  double least_perimeter = 0; ///< faces with a shorter perimeter become part of the region next to them
  double least_width = 0;     ///< so do faces that are narrower; see absorb_small_faces
};

/// Describes what lies inside a shape: curves that edges of the mesh follow, and regions.
struct InnerParts {
  std::vector<Part> curves{}; ///< made by Part::curve
  std::vector<char> clip{}; ///< by curve: whether what lies outside of the shape is left out; otherwise it is an error
  Division division{};
  std::vector<geometry::CurveKind> kinds{}; ///< by curve; an empty list: all curves are of the default kind
};

/// Parts joined by an expression. The shape does not change after construction; all queries are thread-safe.
class RegionShape final : public tracing::Shape {
public:
  /// @brief Parses the expression and makes the boundary.
  /// @param parts parts with different names, none of them `domain`
  /// @param region the expression, see Region::parse
  /// @throws ConfigError for a wrong expression or wrong names. GeometryError if the shape is empty, leaves the
  /// container or has a boundary that touches itself. Also if a part reaches over a periodic side by more than one
  /// period, or was made in a frame with another lattice or place than `frame`. Also if a curve leaves the shape, if a
  /// region has no area in it, or if the container of a shape with curves or regions is periodic
  RegionShape(std::vector<Part> parts, std::string_view region, const geometry::Frame& frame,
              const InnerParts& inner = {});

  /// Returns the domain, which the mesher takes.
  const geometry::Domain& domain() const { return domain_; }
  const geometry::Frame& frame() const { return domain_.frame(); }
  const geometry::Boundary& boundary() const { return domain_.boundary(); }
  /// Sets the points that meshes of this shape keep, see Domain::fixed_points. Fixed points do not change the shape.
  void set_fixed_points(std::vector<geometry::FixedPoint> points) { domain_.set_fixed_points(std::move(points)); }
  /// Returns the given parts, followed by the container under the name `domain`.
  const std::vector<Part>& parts() const { return parts_; }
  const Region& region() const { return region_; }

  /// @brief Returns whether p lies inside. Exact for points of the coordinate lattice; for a point on the boundary the
  /// answer may be either.
  bool inside(geometry::Vec2 p) const;
  /// @brief Returns the distance to the nearest point of the boundary, to within rounding.
  double distance_to_boundary(geometry::Vec2 p) const { return tree_.distance(p); }
  /// Returns the distance to the boundary, with a negative sign inside.
  double signed_distance(geometry::Vec2 p) const override {
    return inside(p) ? -distance_to_boundary(p) : distance_to_boundary(p);
  }

private:
  std::vector<Part> parts_;
  std::vector<std::vector<geometry::Vec2>> shifts_; // the shifts of the periodic images of each part
  Region region_;
  geometry::Domain domain_;
  geometry::PieceTree tree_;
};

/// @brief Makes only the domain, for callers that need nothing else of the shape. Frees the parts and all structures
/// that were needed to find the boundary. The domain is bit-identical to that of a RegionShape.
/// @throws ConfigError, GeometryError under the conditions of the constructor of RegionShape
geometry::Domain domain_of(std::vector<Part> parts, std::string_view region, const geometry::Frame& frame,
                           const InnerParts& inner = {});

/// Traces your own shape: returns a RegionShape that consists of it alone. See traced_part for cost and errors.
RegionShape traced(const tracing::Shape& shape, const geometry::Frame& frame, const std::string& name = "shape");

} // namespace trime::shape
