// SPDX-License-Identifier: BSD-3-Clause
// Measures the quality of the finished mesh. Every triangle and every edge is
// counted once over all ranks. Triangles and edges are processed in blocks, so that the compiler can vectorise the
// loops.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/sizing/size_field.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace trime::extraction {

/// All corners of the boundary with an interior angle below 60 degrees. The list is the same on every rank. Immutable.
class SharpCorners {
public:
  /// A corner and its angle in degrees. An angle of 0 means that there is no corner.
  struct Corner {
    geometry::Vec2 place;
    double degrees = 0;
    geometry::Vec2 ahead{}, back{}; ///< its two chords
  };
  SharpCorners(const polygon::BoundarySites& boundary, const geometry::Periods& periods);
  /// Takes the sharp ones of these corners.
  SharpCorners(std::span<const Corner> corners, const geometry::Periods& periods);

  /// @brief Returns the corner nearest to the vertices of a triangle, if it is at most 3 longest edges of the triangle
  /// away. A corner farther away counts if a vertex lies between its arms, where these are less than the longest edge
  /// apart. Of equally near corners it returns the lexicographically first. Cost: O(corners in a strip of this width).
  Corner near(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r) const;

private:
  void add_if_sharp(const Corner& corner);
  void sort();

  const geometry::Periods& periods_;
  std::vector<Corner> corners_; // in lexicographic order
  double sharpest_ = 90;        // degrees
};

/// Counts bad and obtuse triangles and lists the worst, ordered by alpha and then by place. Objects may be merged in
/// any order.
class BadTriangles {
public:
  struct Counts {
    std::int64_t bad = 0;               ///< number of triangles with an alpha above ExtractionRules::listed_alpha
    std::int64_t obtuse = 0;            ///< number of triangles with an angle above 90 degrees
    std::int64_t obtuse_at_corners = 0; ///< number of obtuse triangles with a sharp corner near them
  };
  /// Adds a bad or obtuse triangle.
  /// @pre its alpha is above ExtractionRules::listed_alpha, or the triangle is obtuse
  void add(const mesh::BadTriangle& triangle);
  void merge(const BadTriangles& other);
  /// Returns the numbers of triangles of this rank so far.
  const Counts& counts() const { return counts_; }
  /// @brief Merges the lists of all ranks into the same list on every rank. Collective.
  /// @param counts numbers over all ranks; if all are 0, nothing is sent
  void gather(const comm::Communicator& comm, const Counts& counts);
  /// Writes the counts, the list, and the worst triangle away from sharp corners into the summary.
  void tell(mesh::QualitySummary& quality) const;

private:
  Counts counts_;
  std::vector<mesh::BadTriangle> worst_; ///< sorted by alpha and place, at most ExtractionRules::most_listed
  mesh::BadTriangle away_;               ///< the worst triangle that is not near a sharp corner
};

/// The largest of some values and its place; of equal values, the lexicographically first place.
struct Extreme {
  double value = -std::numeric_limits<double>::infinity();
  geometry::Vec2 place;

  void note(double its_value, geometry::Vec2 its_place) {
    if (its_value > value || (its_value == value && geometry::lexicographically_less(its_place, place)))
      *this = {its_value, its_place};
  }
};

/// Counts how fast the size grows along the edges.
struct GrowthCounts {
  static constexpr std::size_t bins = 2048;
  static constexpr double width = 1.0 / 1024; ///< width of a bin; the last bin also counts all larger values
  std::array<std::int64_t, bins> counts{};

  void add(double growth) { ++counts[static_cast<std::size_t>(std::min(growth / width, bins - 1.0))]; }
  /// Returns the upper end of the bin that holds this share of all values.
  double quantile(double share) const;
};

/// Sums over triangles and edges. Sums of several threads and ranks can be merged in any order, because the sums are
/// integers, and of equally bad triangles and equally short edges the lexicographically first is kept.
struct QualitySums {
  mesh::RatioStatistics alpha, beta;
  double least_sine = std::numeric_limits<double>::infinity(); ///< sine of the smallest angle of any triangle
  Extreme worst;                                               ///< largest alpha, and the centre of its triangle
  Extreme shortest; ///< length of the shortest edge with a minus sign, and the middle of the edge in the container
  Extreme growth;   ///< largest |change of h| / distance between an end and the middle of an edge, and this middle
  Extreme longest;  ///< largest L / h of an edge of length L, and its middle
  GrowthCounts growth_counts{};
  FixedSum ratio, squared_ratio; ///< sums of L / h and of its square over all edges of length L
  std::int64_t edges = 0;
  BadTriangles bad;

  /// Returns the extreme values in the order in which ranks compare them.
  std::array<const Extreme*, 4> extremes() const { return {&worst, &shortest, &growth, &longest}; }
  void add(const QualitySums& other);
};

/// @brief Returns the summary over all ranks. Takes three reductions, and two gathers if there are bad triangles.
/// Afterwards sums.bad holds the bad triangles of all ranks. Collective.
mesh::QualitySummary summarize(const comm::Communicator& comm, QualitySums& sums);

/// Measures triangles and edges on one thread.
class QualityMeter {
public:
  /// @pre all arguments outlive this object
  QualityMeter(const sizing::SizeField& size, const geometry::Periods& periods, const SharpCorners& corners)
      : size_(&size), periods_(periods), corners_(corners) {}
  /// Without a size field, the caller of add_edge says how large h is in the middle.
  QualityMeter(const geometry::Periods& periods, const SharpCorners& corners) : periods_(periods), corners_(corners) {}

  /// Sets the arrays to which alpha and beta of the following triangles are written, one after the other.
  void write_to(std::span<float> alpha, std::span<float> beta) {
    alpha_ = alpha;
    beta_ = beta;
  }
  void add_triangle(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r);
  /// Adds an edge. @param size_at_p h at the end p
  /// @throws GeometryError if h at the middle of the edge is not positive and finite
  void add_edge(geometry::Vec2 p, geometry::Vec2 q, double size_at_p);
  /// Does the same if there is no size field. @param size_at_middle h at the middle of the edge
  void add_edge(geometry::Vec2 p, geometry::Vec2 q, double size_at_p, double size_at_middle);
  /// Measures the remaining triangles and edges of incomplete blocks.
  void finish();
  QualitySums& sums() { return sums_; }

private:
  static constexpr std::size_t block = 128;
  using Values = std::array<double, block>;
  struct Places {
    Values x, y;
    void set(std::size_t k, geometry::Vec2 p) {
      x[k] = p.x;
      y[k] = p.y;
    }
    geometry::Vec2 operator[](std::size_t k) const { return {x[k], y[k]}; }
  };
  /// An edge until the size in its middle is known.
  struct WaitingEdge {
    geometry::Vec2 from, to;
    double size_at_from;
  };
  void add_waiting_edges();
  void collect_edge(geometry::Vec2 p, geometry::Vec2 q, double size_at_p);
  void measure_triangles();
  void list_if_bad(double alpha, std::size_t k);
  void measure_edges();
  void note_extremes(std::span<const double> length, std::span<const double> size);

  void find_sizes(std::span<double> sizes) const;

  const sizing::SizeField* size_ = nullptr;
  const geometry::Periods& periods_;
  const SharpCorners& corners_;
  QualitySums sums_;
  std::size_t triangles_ = 0, edges_ = 0; // numbers of triangles and edges in the incomplete blocks
  Places p_, q_, r_, from_, to_;
  Values from_size_, middle_size_;   // the latter only if add_edge or add_waiting_edges knows it
  std::vector<WaitingEdge> waiting_; // if the size field prefers blocks
  std::span<float> alpha_, beta_;
};

} // namespace trime::extraction
