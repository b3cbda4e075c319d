// SPDX-License-Identifier: BSD-3-Clause
// Where a sweep wants each inner site to go. One of the two seams of the library (the other is the size field).
#pragma once

#include "trime/core/sum.hpp"
#include "trime/delaunay/star_table.hpp"
#include "trime/mesh/binned_points.hpp"
#include "trime/mesh/local_sizes.hpp"
#include "trime/meshing/alpha_bins.hpp"
#include "trime/meshing/rule_parameters.hpp"
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

  bool is_uniform() const { return is_uniform_; }
  /// h at any point, or image of one.
  double size(geometry::Vec2 p) const {
    return is_uniform_ ? uniform_size_ : size_.size(points.grid().periods().wrap(p));
  }
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

/// Sums of one sweep over the inner sites of a rank, in integers: their order is irrelevant.
struct SweepSums {
  FixedSum squared_length_ratio; ///< L^2 / h_ref^2 over the bars seen from inner sites
  FixedSum squared_size_ratio;   ///< h^2 / h_ref^2 over the same bars, h the mean of both ends
  FixedSum excess_alpha;         ///< alpha - 1, each triangle with an inner site once
  AlphaBins alpha_bins;          ///< of the same triangles
  std::int64_t triangles = 0;
  double max_alpha = 1;
  FixedSum power; ///< of the last move: sum of -move . (move + lead before) / h^2, each term at most 2^10

  void add(const SweepSums& other);
};

/// Adds the star of the inner site i.
void measure_star(const StarView& view, LocalIndex i, double reference_size, SweepSums& sums);

/// Sums over the inner owned sites. Threads over tiles. @param reference_size h_ref, any typical size
SweepSums measure(const StarView& view, double reference_size);

/// What a rule wants of a site: a move to its next iterate, and from there a lead along the way that it came.
struct Step {
  geometry::Vec2 move, lead;
};

/// @brief A gather kernel: the new position of a site from its own ring, neighbours in canonical order, old positions
/// only (Jacobi). The result must be a pure function of these coordinates, of h and of the sums over all ranks.
class UpdateRule {
public:
  virtual ~UpdateRule() = default;
  /// Sums over all ranks, before the sites move.
  virtual void begin_sweep(const SweepSums& sums) = 0;
  /// Step of site i (not capped). Called concurrently.
  virtual Step step(const StarView& view, LocalIndex i) const = 0;
  /// The same for the vector kernels, which move most sites: they give the same bits.
  virtual RuleParameters parameters() const = 0;
};

/// @brief DistMesh (Persson and Strang 2004) as in TriMe++: bars repel where they are shorter than
/// L0 = 1.2 h sqrt(sum L^2 / sum h^2), h the mean of both ends; explicit Euler with step 0.3. Bars between two boundary
/// sites are not in the sums, since the boundary is held.
class DistMeshRule final : public UpdateRule {
public:
  void begin_sweep(const SweepSums& sums) override;
  Step step(const StarView& view, LocalIndex i) const override;
  RuleParameters parameters() const override;

private:
  static constexpr double pressure = 1.2;
  double length_scale_ = pressure; // L0 / h
};

/// @brief Acceleration of a descent (Nesterov 1983): from the iterate x' = y + move(y) the next move is taken at
/// y' = x' + b (x' - x), b = min(0.95, k/(k+3)), and k starts again from 0 when the last moves went uphill
/// (sum of (y - x').(x' - x) / h^2 > 0; O'Donoghue and Candes 2015), which one sweep later is early enough.
class Momentum {
public:
  void begin_sweep(const SweepSums& sums);
  /// The step of site i whose plain move is `move`.
  Step step(const StarView& view, LocalIndex i, geometry::Vec2 move) const;
  double factor() const { return factor_; }

private:
  static constexpr double largest = 0.95;
  int age_ = 0; // sweeps since the last restart
  double factor_ = 0;
};

/// @brief Centroidal Voronoi tessellation by accelerated Lloyd steps (see Momentum).
///
/// Each site goes to the centroid of its Voronoi cell (exact: the polygon of circumcentres of its star; the discs of
/// the boundary segments are empty, so no cell of an inner site leaves the shape) under the weight h^-4. Why 4: a
/// centroidal tessellation minimises the sum over cells of the integral of w |x - site|^2; a cell of spacing d has
/// about w d^4, and in the limit of many sites all cells have the same share (Gersho 1979; Du, Faber and Gunzburger
/// 1999), so d grows like w^(-1/4) and w = h^-4 makes it proportional to h. The weight h^-2 of TriMe++ drifts towards d
/// ~ sqrt(h).
///
/// The weight is linear over each triangle (site, circumcentre, circumcentre), its value at a circumcentre from the
/// mean of h at the three sites: no look into the field, nothing allocated, exact for the uniform weight.
class CvdRule final : public UpdateRule {
public:
  /// @param exponent of 1/h in the weight, 0..8
  explicit CvdRule(int exponent = 4) : exponent_(exponent) {}
  void begin_sweep(const SweepSums& sums) override;
  Step step(const StarView& view, LocalIndex i) const override;
  RuleParameters parameters() const override;
  /// Centroid of the cell of site i, relative to the site; zero if the star has a gap.
  geometry::Vec2 centroid(const StarView& view, LocalIndex i) const;

private:
  int exponent_;
  Momentum momentum_;
};

/// @brief Moves every site towards the minimum of an energy of the triangles around it, their neighbours held.
///
/// The energy of a triangle of area A is S / (4 sqrt(3) A) + k (A/W + W/A - 2): S is the sum of its squared sides, so
/// that the first term is 1 for an equilateral triangle of any size and grows with its shear (Bank and Smith 1997); W
/// is the area that h asks for (the mean of h at its corners, scaled to the mean edge of the whole mesh). One Newton
/// step per site with exact second derivatives, which are positive definite, times 0.7: all sites move at once.
///
/// Why it comes after the cells: where h varies, a mesh must hold dislocations, and between them it is strained. alpha
/// sees shear alone. Voronoi cells resist a change of area 7 times as much as shear, so they leave the strain as shear;
/// a dislocation in a material without any resistance to a change of area has no shear at all (its displacement is
/// b/(2 pi i) log z, which is analytic). k = 1/4 makes the resistance to a change of area half that to shear: alpha - 1
/// falls to less than half, and the standard deviation of L / (s h) grows by a sixth at most. The order of the mesh,
/// that is where its dislocations lie, is better left to the cells.
///
/// W is taken as constant in a step, so that a mesh with A = W everywhere stays as it is.
class TriangleRule final : public UpdateRule {
public:
  static constexpr double stiffness = 0.25; ///< k

  void begin_sweep(const SweepSums& sums) override;
  Step step(const StarView& view, LocalIndex i) const override;
  RuleParameters parameters() const override;

private:
  Momentum momentum_;
  double area_scale_ = 1; // W over sqrt(3)/4 h^2
};

} // namespace trime::meshing
