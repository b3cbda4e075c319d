// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a shape: closed loops of smooth pieces with the interior on the left. The mesher takes a Domain: a
// boundary together with the container in which it was made, the names of its parts, and the fixed points of the mesh.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/region_loss.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trime::geometry {

/// A straight segment or a circular arc from `start` to `end`; both ends lie on the coordinate lattice.
struct Piece {
  Vec2 start, end;
  Vec2 center; ///< only for circular pieces, as are radius, start_angle and sweep
  double radius = 0;
  double start_angle = 0; ///< radians
  double sweep = 0;       ///< signed angle from start to end, radians, counter-clockwise positive, |sweep| <= 2 pi
  int part = 0;           ///< the part of the shape from which the piece comes, as an index into Boundary::part_names
  bool circular = false;
  bool corner = false; ///< the mesh keeps the start as a corner, even if the curve hardly turns there
  int region = 0;      ///< region on the left of a piece of the boundary, as an index into Regions::names
  double wedge = 0; ///< [radians] smallest angle between curves that meet at the start, if one of them lies inside the
                    ///< shape and the angle is below 60 degrees; otherwise 0

  /// Returns the arc length of the piece.
  double length() const;
  /// Returns the point at arc length s from the start, 0 <= s <= length(). For s = 0 and s = length() it returns
  /// `start` and `end` bit for bit.
  Vec2 point(double s) const;
  /// Returns the unit tangent at arc length s.
  Vec2 tangent(double s) const;
  /// Returns the distance from p to the piece.
  double distance(Vec2 p) const;
  /// Returns a box that contains the piece; it may be too large for arcs.
  Box covering_box() const;
};

/// @brief A closed curve: piece i ends where piece i+1 starts. The last piece ends at the start of the first piece plus
/// `winding`.
///
/// In a periodic container the pieces follow each other as if there were no border ("unrolled"). All pieces lie in the
/// container or in one of its neighbouring periodic images. The start of the first piece lies in the container.
struct Loop {
  std::vector<Piece> pieces;
  bool outer =
      true;    ///< true: counter-clockwise around a component; false: clockwise around a hole; true if the loop winds
  int tag = 1; ///< tag of the loop's edges in the mesh file, from 1
  Vec2 winding{}; ///< multiple of the periods; zero unless the loop goes around the periodic container
  /// Above 0 for an open curve as a loop: the pieces before this number lead along the curve, the others back along the
  /// same way.
  std::size_t turning = 0;

  double length() const;
  /// Returns the turn at the start of piece i, in degrees from 0 to 180.
  double turn_degrees(std::size_t i) const;
  /// Returns whether the loop goes around the periodic container.
  bool winds() const { return winding != Vec2{}; }
};

/// The boundary of a shape. Invariant: loops and their periodic images neither cross nor touch, and area > 0.
struct Boundary {
  std::vector<Loop> loops;
  std::vector<std::string> part_names;
  double area = 0; ///< area of the shape, with exact arcs
  Periods periods; ///< periods of the container
  /// True for a component that reaches around the periodic container in both directions. Then all its loops are holes,
  /// or it has no loops.
  bool covers_torus = false;

  int components() const; ///< number of components: outer loops, bands around the container (two loops each), and one
                          ///< if covers_torus
  int holes() const;      ///< number of hole loops
  /// @brief Returns the Euler characteristic of the shape in the plane, on a cylinder or on a torus: outer loops minus
  /// holes. By the theorem of Gauss and Bonnet it is the sum of the turns of the loops; loops around a periodic
  /// container do not turn.
  int euler_characteristic() const;
  double length() const;
  /// Returns the box around the unrolled loops; the box is empty if there are no loops.
  Box bounding_box() const;
};

/// @brief A part of the curves and interfaces inside a shape, from node to node. A node is an end of a curve, a place
/// where curves meet or cross each other or the boundary, or a place where another curve or another pair of regions
/// begins. Arcs meet only in nodes. In a periodic container an arc begins in the container, and its pieces follow each
/// other as those of a Loop do.
struct InnerArc {
  std::vector<Piece> pieces; ///< each begins where the piece before it ends; Piece::part is an index into
                             ///< InnerCurves::names; -1 for an interface on which no curve lies
  int left = 0, right = 0;   ///< regions on both sides, as indices into Regions::names
  bool closed = false;       ///< a ring without a node: it ends where it begins, plus `winding`
  Vec2 winding{}; ///< multiple of the periods; zero unless the arc is closed and goes around the periodic container
  double start_wedge = 0, end_wedge = 0; ///< Piece::wedge at its ends
  bool is_simplified = false;            ///< an interface that is not the one that was given
  double lost_area = 0; ///< area that the simplification has taken from the region on the left, and given to the other;
                        ///< negative if the region on the left has gained it
};

/// Says what the mesh makes of a curve inside a shape.
struct CurveKind {
  /// The curve is a crack or a wall: the points on it are doubled, and both of its sides are boundary edges of the
  /// mesh.
  bool split = false;
  /// Heights and coefficients of a weir in formats of ocean models. Curves without a height are not weirs.
  std::optional<double> weir_height{};
  double weir_subcritical = 1, weir_supercritical = 1;

  bool operator==(const CurveKind&) const = default;
};

/// @brief The curves inside a shape that edges of the mesh follow, and the interfaces between its regions, cut at all
/// their crossings. The mesh keeps all nodes bit for bit.
struct InnerCurves {
  std::vector<InnerArc> arcs;     ///< in the order of the names, then of the files
  std::vector<std::string> names; ///< names of the curves
  /// Lengths of each curve: on the boundary of the shape, where its edges belong to the boundary; and outside of the
  /// shape, where it is left out.
  std::vector<double> on_boundary{}, outside{};
  std::int64_t joined_nodes = 0; ///< nodes that simplification has joined with others, because an edge between them was
                                 ///< far shorter than the triangles
  std::vector<CurveKind> kinds{};   ///< by curve; an empty list: all curves are of the default kind
  std::vector<RegionLoss> losses{}; ///< what regions have lost where nodes were joined or wedges cut, place by place
  bool empty() const { return arcs.empty(); }
};

/// An area that two regions were given and that the first of them has.
struct RegionOverlap {
  int first, second; ///< indices into Regions::names
  double area;
  Vec2 place; ///< on the boundary of the overlap
};

/// Faces of the division that were smaller or narrower than the triangles, and belong to their neighbours now.
struct AbsorbedFaces {
  std::int64_t count = 0;
  double area = 0;
  double largest = 0;              ///< area of the largest face
  Vec2 place;                      ///< on the boundary of the largest face
  std::vector<RegionLoss> faces{}; ///< the region that loses each face, and the one that gets it
};

/// @brief The regions into which a shape is divided, such as materials. Region 0 is the rest, which no other region
/// covers; it may be empty. In a mesh the regions have the numbers 1, 2, ... in the same order.
struct Regions {
  std::vector<std::string> names;          ///< at least that of the rest
  std::vector<std::array<int, 2>> pairs{}; ///< regions that share an interface, the lower one first, in ascending order
  std::vector<double> areas{};             ///< area of each region in the shape as it was given
  std::vector<double> outside{};           ///< area of each region as it was given that lies outside of the shape
  AbsorbedFaces absorbed{};
  std::vector<RegionOverlap> overlaps{}; ///< overlaps that are larger than rounding errors, in the order of the regions
  /// Returns whether the shape is divided.
  bool any() const { return names.size() > 1; }
  /// Returns the index in `pairs` of two regions in any order; -1 if they share no interface. Cost: O(log pairs).
  int pair_of(int a, int b) const;
  /// Returns the name of the interface between the regions of a pair, such as `rock|soil`.
  std::string pair_name(std::size_t pair) const {
    return names[static_cast<std::size_t>(pairs[pair][0])] + "|" + names[static_cast<std::size_t>(pairs[pair][1])];
  }
};

/// A point that the user wants as a vertex of the mesh.
struct FixedPoint {
  Vec2 position;
  std::string label; ///< origin of the point for messages, such as `points.xy:7`
};

/// @brief The domain of a mesh. Functions of the module shape make it (shape::RegionShape::domain, shape::domain_of),
/// and the mesher takes it.
///
/// The names of the parts are Boundary::part_names. Pieces whose segments have a marker other than 0 form a separate
/// part, listed after all parts without markers: "NAME.MARKER", or "NAME.TEXT" if the file has a name for the marker.
/// Where two such parts meet on one curve there is a corner.
class Domain {
public:
  /// @brief Checks that the boundary belongs to the frame, and stores both. Cost: O(pieces).
  /// @param part_markers one marker for each of boundary.part_names; 0 means no marker. Empty: no part has a marker
  /// @throws GeometryError if a vertex of the boundary lies off the coordinate lattice or outside of the container, if
  /// a loop is not closed, or if periods, names or markers do not agree
  Domain(const Frame& frame, Boundary boundary, std::vector<std::int32_t> part_markers = {});

  const Frame& frame() const { return frame_; }
  const Boundary& boundary() const { return boundary_; }
  /// The marker of each part in Boundary::part_names; 0 if the part has none.
  const std::vector<std::int32_t>& part_markers() const { return part_markers_; }

  /// @brief The points that the mesh keeps bit for bit (on the coordinate lattice) and never moves. Fixed points on the
  /// boundary (to within 1e-10 of the container) become corners; for fixed points outside of the shape the mesher
  /// throws a GeometryError.
  const std::vector<FixedPoint>& fixed_points() const { return fixed_points_; }
  void set_fixed_points(std::vector<FixedPoint> points) { fixed_points_ = std::move(points); }

  /// The curves inside the shape. Where one of them meets the boundary, a piece of the boundary begins with a corner.
  const InnerCurves& curves() const { return curves_; }
  void set_curves(InnerCurves curves) { curves_ = std::move(curves); }

  /// The regions of the shape. Where an interface between them meets the boundary, a piece of the boundary begins.
  const Regions& regions() const { return regions_; }
  void set_regions(Regions regions) { regions_ = std::move(regions); }
  /// Returns what messages call a line inside: the curve with this number, or if that is -1 the interface between these
  /// regions.
  std::string line_name(int curve, int left, int right) const;

private:
  Frame frame_;
  Boundary boundary_;
  std::vector<std::int32_t> part_markers_;
  std::vector<FixedPoint> fixed_points_;
  InnerCurves curves_;
  Regions regions_;
};

} // namespace trime::geometry
