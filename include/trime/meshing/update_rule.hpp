// SPDX-License-Identifier: BSD-3-Clause
// Where a sweep wants each inner site to go. One of the two seams of the library (the other is the size field).
#pragma once

#include "trime/core/sum.hpp"
#include "trime/delaunay/star_table.hpp"
#include "trime/mesh/binned_points.hpp"
#include "trime/mesh/local_sizes.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::meshing {

/// What a rule sees: certified stars around the inner sites, and h.
class StarView {
public:
  /// @param sizes h at the sites, as far as it is known; null: to be evaluated
  StarView(const mesh::BinnedPoints& all_points, const delaunay::StarTable& all_stars, const sizing::SizeField& field,
           const mesh::LocalSizes* sizes = nullptr)
      : points(all_points), stars(all_stars), size_(field), sizes_(sizes), is_uniform_(field.is_uniform()),
        uniform_size_(is_uniform_ ? field.size({}) : 0) {}

  /// h at any point.
  double size(geometry::Vec2 p) const { return is_uniform_ ? uniform_size_ : size_.size(p); }
  /// h at site i, owned or ghost: a look-up where it is known, the same bits as size(points.position(i)).
  double size(LocalIndex i) const { return sizes_ && sizes_->known(i) ? (*sizes_)[i] : size(points.position(i)); }

  const mesh::BinnedPoints& points;
  const delaunay::StarTable& stars;

private:
  const sizing::SizeField& size_;
  const mesh::LocalSizes* sizes_;
  bool is_uniform_;
  double uniform_size_;
};

/// Sums of one sweep over the inner sites of a rank, in fixed point: their order is irrelevant.
struct SweepSums {
  FixedSum squared_length_ratio; ///< L^2 / h_ref^2 over the bars seen from inner sites
  FixedSum squared_size_ratio;   ///< h(mid)^2 / h_ref^2 over the same bars
  FixedSum excess_alpha;         ///< alpha - 1, each triangle with an inner site once
  std::int64_t triangles = 0;
  double max_alpha = 1;

  void add(const SweepSums& other);
};

/// Sums over the inner owned sites. Threads over tiles. @param reference_size h_ref, any typical size
SweepSums measure(const StarView& view, double reference_size);

/// @brief A gather kernel: the new position of a site from its own ring, neighbours in canonical order, old positions
/// only (Jacobi). The result must be a pure function of these coordinates, of h and of the sums over all ranks.
class UpdateRule {
public:
  virtual ~UpdateRule() = default;
  /// Sums over all ranks, before the sites move.
  virtual void begin_sweep(const SweepSums& sums) = 0;
  /// Displacement of site i (not capped). Called concurrently.
  virtual geometry::Vec2 displacement(const StarView& view, LocalIndex i) const = 0;
};

/// @brief DistMesh (Persson and Strang 2004) as in TriMe++: bars repel where they are shorter than
/// L0 = 1.2 h(mid) sqrt(sum L^2 / sum h^2); explicit Euler with step 0.3. Bars between two boundary sites are not in
/// the sums, since the boundary is held.
class DistMeshRule final : public UpdateRule {
public:
  void begin_sweep(const SweepSums& sums) override;
  geometry::Vec2 displacement(const StarView& view, LocalIndex i) const override;

private:
  static constexpr double time_step = 0.3, pressure = 1.2;
  double length_scale_ = pressure; // L0 / h
};

} // namespace trime::meshing
