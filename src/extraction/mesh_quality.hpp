// SPDX-License-Identifier: BSD-3-Clause
// Quality of the finished mesh: every triangle and every edge once, over all ranks. Triangles and edges are taken in
// blocks, so that the compiler works on several at a time.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/periods.hpp"
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

  /// A corner and its angle; none: 0 degrees.
  struct Corner {
    geometry::Vec2 place;
    double degrees = 0;
  };
  /// @brief The nearest corner within 3 longest edges of a triangle, by its vertices; the first in lexicographic order
  /// of equally near ones. O(corners in a strip of this width).
  Corner near(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r) const;

private:
  const geometry::Periods& periods_;
  std::vector<Corner> corners_; // in lexicographic order
};

/// Mergeable in any order: the list is that of the worst, by alpha and then by place.
class BadTriangles {
public:
  /// @pre alpha is above ExtractionRules::listed_alpha
  void add(const mesh::BadTriangle& triangle);
  void merge(const BadTriangles& other);
  /// The triangles of this rank so far.
  std::int64_t count() const { return count_; }
  /// @brief Returns the list over all ranks, the same on every rank; each rank sends only its list. @param count over
  /// all ranks, which send nothing if it is 0. Collective.
  void gather(const comm::Communicator& comm, std::int64_t count);
  /// Writes count, list, and the worst away from corners into the summary.
  void tell(mesh::QualitySummary& quality) const;

private:
  std::int64_t count_ = 0;
  std::vector<mesh::BadTriangle> worst_; ///< sorted, at most ExtractionRules::most_listed
  mesh::BadTriangle away_;               ///< the worst that no corner excuses
};

/// Mergeable: sums are integers inside, the worst triangle and the shortest edge are the lexicographically first of
/// equals.
struct QualitySums {
  mesh::RatioStatistics alpha, beta;
  double least_sine = std::numeric_limits<double>::infinity(); ///< of the smallest angle of a triangle
  double worst_alpha = 0;
  geometry::Vec2 worst_place;
  double shortest = std::numeric_limits<double>::infinity(); ///< length of an edge
  geometry::Vec2 shortest_place;                             ///< its middle, in the container
  FixedSum ratio, squared_ratio;                             ///< L / h over edges
  std::int64_t edges = 0;
  BadTriangles bad;

  void note_worst(double a, geometry::Vec2 place);
  void note_shortest(double length, geometry::Vec2 place);
  void add(const QualitySums& other);
};

/// @brief The summary over all ranks, in three reductions; two gathers more if there are bad triangles. Afterwards
/// sums.bad is that of all ranks. Collective.
mesh::QualitySummary summarize(const comm::Communicator& comm, QualitySums& sums);

/// The measurements of one thread.
class QualityMeter {
public:
  /// @pre all outlive this object
  QualityMeter(const sizing::SizeField& size, const geometry::Periods& periods, const SharpCorners& corners)
      : size_(size), periods_(periods), corners_(corners) {}

  /// From here on the ratios of the triangles go to these places, one after the other.
  void write_to(std::span<float> alpha, std::span<float> beta) {
    alpha_ = alpha;
    beta_ = beta;
  }
  void add_triangle(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r);
  /// @throws GeometryError if h in the middle of an edge is not positive and finite
  void add_edge(geometry::Vec2 p, geometry::Vec2 q);
  /// Measures what still waits.
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
  std::size_t triangles_ = 0, edges_ = 0; // that wait
  Places p_, q_, r_, from_, to_;
  std::span<float> alpha_, beta_;
};

} // namespace trime::extraction
