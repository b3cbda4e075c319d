// SPDX-License-Identifier: BSD-3-Clause
// Quality of the finished mesh: every triangle and every edge once, over all ranks. Triangles and edges are taken in
// blocks, so that the compiler works on several at a time.
#pragma once

#include "extraction/bad_triangles.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/periods.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/sizing/size_field.hpp"

#include <array>
#include <limits>
#include <span>

namespace trime::extraction {

/// Mergeable: sums are integers inside, the worst triangle is the lexicographically first of equals.
struct QualitySums {
  mesh::RatioStatistics alpha, beta;
  double least_sine = std::numeric_limits<double>::infinity(); ///< of the smallest angle of a triangle
  double worst_alpha = 0;
  geometry::Vec2 worst_place;
  FixedSum ratio, squared_ratio; ///< L / h over edges
  std::int64_t edges = 0;
  BadTriangles bad;

  void note_worst(double a, geometry::Vec2 place);
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
