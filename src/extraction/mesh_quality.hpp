// SPDX-License-Identifier: BSD-3-Clause
// Measures the quality of the finished mesh. Every triangle and every edge counts once over all ranks. They are
// processed in blocks, so that the compiler can vectorise the loops.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/sizing/size_field.hpp"

#include <array>
#include <limits>
#include <span>
#include <vector>

namespace trime::extraction {

/// The corners of the boundary that are sharper than 60 degrees on the inside. Replicated, immutable.
class SharpCorners {
public:
  SharpCorners(const polygon::BoundarySites& boundary, const geometry::Periods& periods);

  /// A corner and its angle in degrees; 0 if there is no corner.
  struct Corner {
    geometry::Vec2 place;
    double degrees = 0;
    geometry::Vec2 ahead{}, back{}; ///< its two chords
  };
  /// @brief Returns the corner nearest to the vertices of a triangle, within 3 of its longest edges. A corner farther
  /// away counts if a vertex lies between its arms, where these are less than the longest edge apart. Of equally near
  /// ones it returns the first in lexicographic order. O(corners in a strip of this width).
  Corner near(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r) const;

private:
  const geometry::Periods& periods_;
  std::vector<Corner> corners_; // in lexicographic order
  double sharpest_ = 90;        // degrees
};

/// Counts bad triangles and lists the worst, by alpha and then by place. Objects may be merged in any order.
class BadTriangles {
public:
  /// @pre alpha is above ExtractionRules::listed_alpha
  void add(const mesh::BadTriangle& triangle);
  void merge(const BadTriangles& other);
  /// Number of triangles of this rank so far.
  std::int64_t count() const { return count_; }
  /// @brief Merges the lists of all ranks into the same list on every rank. Collective. @param count number over all
  /// ranks; if it is 0, nothing is sent
  void gather(const comm::Communicator& comm, std::int64_t count);
  /// Writes the count, the list, and the worst triangle away from sharp corners into the summary.
  void tell(mesh::QualitySummary& quality) const;

private:
  std::int64_t count_ = 0;
  std::vector<mesh::BadTriangle> worst_; ///< sorted, at most ExtractionRules::most_listed
  mesh::BadTriangle away_;               ///< the worst triangle that is not near a sharp corner
};

/// Sums over triangles and edges. They can be merged in any order: sums are integers inside, and of equally bad
/// triangles and equally short edges the lexicographically first is kept.
struct QualitySums {
  mesh::RatioStatistics alpha, beta;
  double least_sine = std::numeric_limits<double>::infinity(); ///< sine of the smallest angle of a triangle
  double worst_alpha = 0;
  geometry::Vec2 worst_place;
  double shortest = std::numeric_limits<double>::infinity(); ///< length of the shortest edge
  geometry::Vec2 shortest_place;                             ///< its middle, in the container
  FixedSum ratio, squared_ratio;                             ///< sums of L / h over edges
  std::int64_t edges = 0;
  BadTriangles bad;

  void note_worst(double a, geometry::Vec2 place);
  void note_shortest(double length, geometry::Vec2 place);
  void add(const QualitySums& other);
};

/// @brief Returns the summary over all ranks by three reductions, and two more gathers if there are bad triangles.
/// Afterwards sums.bad holds the bad triangles of all ranks. Collective.
mesh::QualitySummary summarize(const comm::Communicator& comm, QualitySums& sums);

/// Measures triangles and edges on one thread.
class QualityMeter {
public:
  /// @pre all arguments outlive this object
  QualityMeter(const sizing::SizeField& size, const geometry::Periods& periods, const SharpCorners& corners)
      : size_(size), periods_(periods), corners_(corners) {}

  /// Makes the ratios of the following triangles go to these arrays, one after the other.
  void write_to(std::span<float> alpha, std::span<float> beta) {
    alpha_ = alpha;
    beta_ = beta;
  }
  void add_triangle(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r);
  /// @throws GeometryError if h in the middle of an edge is not positive and finite
  void add_edge(geometry::Vec2 p, geometry::Vec2 q);
  /// Measures the triangles and edges that still wait.
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
  void measure_triangles();
  void list(double alpha, std::size_t k);
  void measure_edges();

  const sizing::SizeField& size_;
  const geometry::Periods& periods_;
  const SharpCorners& corners_;
  QualitySums sums_;
  std::size_t triangles_ = 0, edges_ = 0; // number that wait for a full block
  Places p_, q_, r_, from_, to_;
  std::span<float> alpha_, beta_;
};

} // namespace trime::extraction
