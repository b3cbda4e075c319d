// SPDX-License-Identifier: BSD-3-Clause
// Cuts the boundaries of several parts at all their crossings. The resulting pieces meet only at common vertices.
#pragma once

#include "geometry/segment_tree.hpp"
#include "shape/vertex_table.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace trime::shape {

/// One part in an arrangement, or one of its periodic images.
struct PlacedPart {
  const Part* part;
  int index;            ///< index of the part in the region; -1 for a rectangle that only cuts the others
  geometry::Vec2 shift; ///< shift of the periodic image; a point of the coordinate lattice
};

/// @brief The arrangement of the boundaries, which the constructor computes. Cost: O(M log M) for M pieces of any
/// number of parts if few of them cross, even for long slanted spikes next to each other.
///
/// Crossings are rounded to the coordinate lattice; a crossing within VertexTable::merge_steps of a vertex becomes that
/// vertex. Vertices of contours keep their exact coordinates. Coinciding pieces are kept once. A cutting rectangle must
/// be the last part: it is crossed with the pieces of all other parts.
class Arrangement {
public:
  /// Distance, in lattice steps, within which a vertex counts as lying on a curve.
  static constexpr int on_curve_steps = 4;

  /// A piece from vertex to vertex. A piece is straight, or runs counter-clockwise along a circle by at most a quarter
  /// turn.
  struct Piece {
    LocalIndex from, to;
    int circle;            ///< index into circles(); -1 for straight pieces
    int part;              ///< position in the list of the part whose interior lies on the left
    LocalIndex first_twin; ///< index into twins() of the other parts with the same piece: first_twin .. first_twin +
                           ///< twin_count - 1
    LocalIndex twin_count;
  };
  struct Twin {
    int part;
    bool along; ///< true if the interior of this part is on the left; otherwise it is on the right
  };

  Arrangement(const std::vector<PlacedPart>& parts, const geometry::Frame& frame);

  const std::vector<Piece>& pieces() const { return pieces_; }
  const std::vector<Twin>& twins() const { return twins_; }
  const std::vector<Circle>& circles() const { return circles_; }
  const VertexTable& vertices() const { return vertices_; }
  /// Returns the number of pairs of parts that were crossed with each other, as a measure of work.
  std::int64_t pairs() const { return pairs_; }
  /// Returns the number of examined pairs of lines of two polygons, or of a line and a circle.
  std::int64_t line_pairs() const { return line_pairs_; }

private:
  struct Line {
    LocalIndex from, to;
    int part;
  };
  /// How two lines touch or cross each other.
  struct Contact {
    std::array<bool, 4> on{}; ///< whether each end of the first line lies on the second line between its ends; then the
                              ///< same for the ends of the second
    bool crossing = false;
    bool any() const { return on[0] || on[1] || on[2] || on[3] || crossing; }
  };
  enum class Place { apart, at_end, between };
  /// The ways to find those lines of a part that are near a given line, with counts to choose between them.
  struct LineSearch {
    std::int64_t lines = 0;     ///< number of lines and circles for which near lines were searched
    std::int64_t looked_at = 0; ///< number of lines that were examined in the bins of the part
    std::optional<geometry::SegmentTree> tree;
  };
  struct Split {
    LocalIndex curve, vertex; // a line, or lines_.size() plus the number of a circle
  };

  void add_polygon(std::size_t place);
  void add_circles();
  void cross_all();
  void cross_circles(LocalIndex a, LocalIndex b);
  void cross_polygons(std::size_t a, std::size_t b);
  std::vector<LocalIndex> lines_near(std::size_t a, geometry::Box box);
  void cross_polygon_circle(std::size_t a, LocalIndex circle);
  void cross_by_tree(LocalIndex s, std::size_t b);
  bool wants_tree(std::size_t b);
  void cross_lines(LocalIndex s, LocalIndex t);
  Contact contact_of(LocalIndex s, LocalIndex t) const;
  Place place_on(LocalIndex line, LocalIndex vertex) const;
  void split_line(LocalIndex line, LocalIndex vertex);
  void split_circle(LocalIndex circle, LocalIndex vertex);
  void add_contact(LocalIndex line, LocalIndex circle);
  void make_pieces();
  void chain_line(LocalIndex line, const Split* first, const Split* last);
  void chain_circle(LocalIndex circle, const Split* first, const Split* last);
  void join_twins();

  geometry::Segment segment(LocalIndex line) const {
    return {vertices_.point(lines_[line].from), vertices_.point(lines_[line].to)};
  }
  /// Returns the line shifted back to the coordinates of a part, which may be a periodic image.
  geometry::Segment moved_back(LocalIndex line, std::size_t part) const {
    return {segment(line).a - parts_[part].shift, segment(line).b - parts_[part].shift};
  }
  geometry::Box box_for(const geometry::Segment& moved) const;

  const std::vector<PlacedPart>& parts_;
  const geometry::Frame& frame_;
  double tolerance_;
  VertexTable vertices_;
  std::vector<Line> lines_;            // used, like splits_, only until the pieces are made
  std::vector<LocalIndex> first_line_; // index of the first line of each polygon in parts_; unused for circles
  std::vector<Circle> circles_;
  std::vector<std::vector<int>> circle_parts_;
  std::vector<Split> splits_;
  std::vector<Piece> pieces_;
  std::vector<Twin> twins_;
  std::vector<LineSearch> searches_; // one for each part; used only while parts are crossed
  std::int64_t pairs_ = 0, line_pairs_ = 0;
};

} // namespace trime::shape
