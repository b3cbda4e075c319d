// SPDX-License-Identifier: BSD-3-Clause
// Declares the update rules: they compute the step of each inner site in a sweep.
#pragma once

#include "core/state_fields.hpp"
#include "sites/site_state.hpp"
#include "sweep/rule_formulas.hpp"
#include "sweep/sweep_sums.hpp"
#include "trime/geometry/vec2.hpp"

namespace trime::sweep {

/// The result of an update rule for a site: a move to its next iterate, and a lead, the momentum part beyond it in the
/// direction of the last move.
struct Step {
  geometry::Vec2 move, lead;
};

/// @brief Computes the step of a site from its neighbours alone, in canonical order and at their old places, so that
/// all sites may move at once (Jacobi). The step is a pure function of these places, of the target edge length h, and
/// of sums over all ranks. Users cannot add rules, because the vector kernels contain every rule.
class UpdateRule {
public:
  virtual ~UpdateRule() = default;
  /// Receives the sums over all ranks before the sites move.
  virtual void begin_sweep(const SweepSums& sums) = 0;
  /// Returns the step of site i, which may be longer than the largest allowed move. Called concurrently.
  virtual Step step(const sites::StarView& view, LocalIndex i) const = 0;
  /// Returns the parameters of the rule for the vector kernels, which move most sites and compute bit-identical steps.
  virtual RuleParameters parameters() const = 0;
  /// Visits the members that are stored in a checkpoint. Called before begin_sweep.
  virtual void visit(StateFields&) {}
};

/// @brief The rule of DistMesh (Persson and Strang 2004) as in TriMe++. Each edge is a bar that repels its ends if it
/// is shorter than L0 = 1.2 h sqrt(sum L^2 / sum h^2), where h is the mean at both ends. Sites move by explicit Euler
/// steps of 0.3. Edges between two boundary sites are left out of the sums, because the boundary does not move.
class DistMeshRule final : public UpdateRule {
public:
  void begin_sweep(const SweepSums& sums) override;
  Step step(const sites::StarView& view, LocalIndex i) const override;
  RuleParameters parameters() const override;
  void visit(StateFields& fields) override { fields.field("length_scale", length_scale_); }

private:
  double length_scale_ = SweepRules::bar_pressure; // L0 / h
};

/// @brief Accelerates the moves of a rule (Nesterov 1983). After the iterate x' = y + move(y), the next move starts
/// from y' = x' + b (x' - x). Here b = min(SweepRules::largest_momentum, k/(k+3)). k starts again from 0 when the last
/// moves went uphill, that is, when the sum of (y - x').(x' - x) / h^2 is positive (O'Donoghue and Candes 2015). That
/// sum is the one of the last sweep; a restart one sweep later is early enough.
class Momentum {
public:
  void begin_sweep(const SweepSums& sums);
  /// Returns the step of site i, where `move` is the move of the rule without momentum.
  Step step(const sites::StarView& view, LocalIndex i, geometry::Vec2 move) const;
  double factor() const { return factor_; }
  void visit(StateFields& fields) { fields.field("momentum_age", age_); }

private:
  int age_ = 0; // sweeps since the last restart
  double factor_ = 0;
};

/// @brief Centroidal Voronoi tessellation by accelerated Lloyd steps (see Momentum).
///
/// Each site goes to the centroid of its Voronoi cell under the weight h^-4. The cell is the polygon of the
/// circumcentres of the star. Because the diametral circles of the boundary edges are empty, no cell of an inner site
/// leaves the shape. Why the exponent is 4: a centroidal tessellation minimises the sum over cells of the integral of w
/// |x - site|^2. A cell of width d contributes about w d^4, and in the limit of many sites all cells contribute equally
/// (Gersho 1979; Du, Faber and Gunzburger 1999). So d is proportional to w^(-1/4), and w = h^-4 makes d proportional to
/// h. With the weight h^-2 of TriMe++, the sites drift towards a spacing d proportional to sqrt(h).
///
/// The weight is interpolated linearly over each triangle (site, circumcentre, circumcentre); its value at a
/// circumcentre follows from the mean of h at the three corners. So the size field is not evaluated, and no memory is
/// allocated. For a uniform weight the centroid is exact.
class CvdRule final : public UpdateRule {
public:
  /// @param exponent exponent of 1/h in the weight, 0..8
  explicit CvdRule(int exponent = SweepRules::density_exponent) : exponent_(exponent) {}
  void begin_sweep(const SweepSums& sums) override;
  Step step(const sites::StarView& view, LocalIndex i) const override;
  RuleParameters parameters() const override;
  void visit(StateFields& fields) override { momentum_.visit(fields); }
  /// Returns the centroid of the Voronoi cell of site i, relative to the site; zero if the star has a gap.
  geometry::Vec2 centroid(const sites::StarView& view, LocalIndex i) const;

private:
  int exponent_;
  Momentum momentum_;
};

/// @brief Moves every site towards the minimum of an energy of the triangles around it, with its neighbours fixed.
///
/// The energy of a triangle of area A is S / (4 sqrt(3) A) + k (A/W + W/A - 2). S is the sum of its squared sides, so
/// the first term is 1 for an equilateral triangle of any size and grows with its shear (Bank and Smith 1997). W is the
/// wanted area, from the mean of h at the corners, scaled to the mean edge of the whole mesh. Each site makes 0.7 of a
/// Newton step with exact second derivatives, which are positive definite. The step is damped because all sites move at
/// once.
///
/// Why this rule follows the Voronoi rule: where h varies, a mesh must contain dislocations, and between them it is
/// strained. alpha depends only on the shear of a triangle. Voronoi cells resist a change of area 7 times as much as
/// shear, so they leave the strain as shear. A dislocation in a material without resistance to a change of area has no
/// shear (its displacement is b/(2 pi i) log z, which is analytic). With k = 1/4 the resistance to a change of area is
/// half that to shear: alpha - 1 falls to less than half, and the standard deviation of L / (s h) grows by at most a
/// sixth. The Voronoi rule is better at placing the dislocations.
///
/// The wanted area W is constant during a step, so a mesh with A = W everywhere does not change.
class TriangleRule final : public UpdateRule {
public:
  void begin_sweep(const SweepSums& sums) override;
  Step step(const sites::StarView& view, LocalIndex i) const override;
  RuleParameters parameters() const override;
  void visit(StateFields& fields) override {
    momentum_.visit(fields);
    fields.field("area_scale", area_scale_);
  }

private:
  Momentum momentum_;
  double area_scale_ = 1; // W over sqrt(3)/4 h^2
};

} // namespace trime::sweep
