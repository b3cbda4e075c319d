// SPDX-License-Identifier: BSD-3-Clause
// Decides how the points come into the mesh: all at once, by dividing a coarse mesh repeatedly, or by insertions in
// several stages. Also defines the options of these stages.
#pragma once

#include "core/state_fields.hpp"
#include "fitting/fit.hpp"
#include "placing/hilbert_start.hpp"
#include "placing/lattice_start.hpp"
#include "start/old_points.hpp"
#include "trime/start/start_choice.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace trime::start {

struct DensityChanges;

/// The options of the start. MeshOptions explains each option and its default.
struct StartOptions {
  std::uint64_t seed = 0;
  Start start = Start::automatic;
  std::optional<double> initial_fraction;
  bool cleanup = false;           ///< true if a clean-up follows, for which some points are held back
  const OldPoints* old = nullptr; ///< where the sites start; null: at new places
};

/// @brief The stages of a run. Lattice: one stage that starts from a hexagonal lattice with the right number of points.
/// Hilbert: one stage whose sites start along the Hilbert curve. Coarse to fine: 1/4^k of the points are relaxed, then
/// all edges are divided, k times; this gives the quality of 100 sweeps at the cost of 20. Insertion, as in TriMe++:
/// the run begins with a share of the points, and each further stage adds 60 % in the triangles that are largest
/// relative to h, while h is scaled to the new number. Old mesh: the points of another mesh are thinned and refilled in
/// one or a few stages until they have the wanted density; only the last of these stages is relaxed.
class PointScheme {
public:
  PointScheme(const fitting::LayoutContext& context, const StartOptions& options);

  /// Returns the first stage, with its sites distributed over the ranks. Collective.
  /// @throws ConfigError if there are too few points for the shape or for max_size; GeometryError if the shape cannot
  /// be meshed; both on all ranks together
  sites::Stage first();
  /// @brief Returns the last stage as it will be laid out, without its sites unless the first one is the last.
  /// Collective. @param first the stage that first() has just returned @pre no other stage follows
  sites::Stage last_from(sites::Stage first);
  /// Returns the next stage. Collective.
  /// @param builder the builder that made the stars of `previous`, if the next stage may keep them; otherwise null
  /// @param previous afterwards without its sites if relaxes() is false
  /// @pre !is_last(), and the stars of all sites of `previous` are certain
  sites::Stage next(sites::Stage& previous, const delaunay::StarBuilder* builder);
  /// @brief Returns the current stage of a run that continues from a checkpoint, with the same boundary as in the
  /// checkpointed run but without sites. Collective.
  /// @param first the stage that first() returned
  /// @pre visit() has restored the numbers since then
  sites::Stage lay_again_from(sites::Stage first);
  /// Visits the members that are stored in a checkpoint.
  void visit(StateFields& fields);
  /// Returns true if no further stage follows.
  bool is_last() const { return stage_ == last_stage_; }
  /// Returns true if sweeps follow in this stage. In the other ones only the number of sites changes.
  bool relaxes() const { return scheme_ != Scheme::old_mesh || is_last(); }
  /// Returns true if the sites of this stage are those of a relaxed mesh except for a small share.
  bool is_nearly_relaxed() const { return scheme_ == Scheme::old_mesh && changes_.is_small(); }
  /// Returns the number of the stage; those that are not relaxed do not count.
  int relaxed_stage() const { return scheme_ == Scheme::old_mesh ? 0 : stage_; }
  int last_relaxed_stage() const { return scheme_ == Scheme::old_mesh ? 0 : last_stage_; }
  int stage() const { return stage_; }
  /// Returns the number of the last stage, as far as known: insertions may need more stages.
  int last_stage() const { return last_stage_; }
  /// Returns true if later stages insert points into the mesh of this stage.
  bool inserts() const { return scheme_ == Scheme::insertion; }

  /// Returns the places where the boundary needs smaller triangles than the size that was asked for.
  /// @pre first() was called
  std::span<const sizing::SizeLimit> limits() const { return fit_.limits(); }
  /// Returns where the size was raised, because edges would be too short there. @pre first() was called
  const std::vector<sizing::LeastSize>& raised() const { return fit_.context().raised; }
  /// Returns where the size is limited because it grows too fast. @pre first() was called
  const fitting::SteepPlaces& steep() const { return fit_.steep(); }
  /// Returns the factor of a size that varies. @pre first() was called
  double factor() const { return fit_.factor(); }
  /// Returns which curves were joined with interfaces. @pre first() was called
  const fitting::JoinedLines& joined_lines() const { return fit_.joined_lines(); }
  /// Returns in one line which scheme was chosen and why.
  const std::string& reason() const { return reason_; }
  /// Returns why the scheme made fewer points than requested; empty if it made enough.
  const std::string& shortage() const { return shortage_; }

private:
  enum class Scheme { lattice, hilbert, coarse_to_fine, insertion, old_mesh };

  /// The first stage, or an error value if there are too few points for it.
  using First = std::variant<sites::Stage, fitting::TooFewPoints>;
  First first_or_few();
  double enough_points(double fewest) const;

  void choose();
  void choose_divisions();
  GlobalId reserve() const;
  double expected_points() const;
  First first_of_scheme();
  First first_of_lattice();
  First first_of_graded_size();
  void share_runs(const placing::LatticeStart& start, fitting::LatticeFit& fit) const;
  First first_of_insertion();
  First first_of_zoned_lattice(fitting::ZonedLattice found);
  First first_of_divisions();
  First first_of_divisions(fitting::StageFit fit);
  std::variant<fitting::StageFit, fitting::TooFewPoints> find_last();
  First first_of_old_mesh();
  std::variant<fitting::StageFit, fitting::TooFewPoints> lay_last();
  std::string reason_of_divisions() const;
  sites::Stage lay_division(sites::Stage& last, double expected);
  sites::Stage lay_insertion();
  std::unique_ptr<const placing::HilbertStart> along_curve(const sites::Stage& stage, double expected,
                                                           double coarsening) const;
  mesh::SiteList sites_along_curve(const sites::Stage& stage, double inner, const placing::HilbertStart& start) const;
  /// Return the next stage after `previous`.
  sites::Stage divide(const sites::Stage& previous);
  sites::Stage insert(const sites::Stage& previous);
  sites::Stage follow_density(sites::Stage previous, const delaunay::StarBuilder* builder);
  bool are_edits(const sites::Stage& stage, const DensityChanges& made) const;

  const fitting::LayoutContext& given_;
  fitting::Fit fit_;
  const StartOptions options_;
  const double asked_points_; // number of points that was asked for, or that the sizes take
  Scheme scheme_ = Scheme::lattice;
  int stage_ = 0, last_stage_ = 0;
  sites::Stage laid_last_;  // last stage of the scheme coarse to fine, prepared in advance
  double points_now_ = 0;   // for insertions: number of points for which the current stage aims
  double expected_ = 0;     // for coarse to fine and old meshes: number of points for which the stage was prepared
  double wanted_inner_ = 0; // for old meshes: number of inner sites that have the wanted density
  OldPointsSummary changes_;
  std::string reason_, shortage_;
};

} // namespace trime::start
