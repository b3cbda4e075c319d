// SPDX-License-Identifier: BSD-3-Clause
// The surroundings of bad triangles and the changes that are tried there. One thread; knows nothing of ranks.
#pragma once

#include "cleanup/patch.hpp"
#include "cleanup/patch_contest.hpp"

#include <optional>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief Compares a patch with what it was at its start.
class PatchReport {
public:
  /// References must outlive the object.
  PatchReport(const PatchStart& start, const PatchRests& rests) : start_(start), rests_(rests) {}

  /// The difference between the sites and what they have become. @param patch see PatchOptimizer::improve
  std::vector<SiteEdit> edits(const Patch& now, std::uint64_t patch) const;
  /// Which sites on the boundary have other next ones than before, or another place.
  std::vector<BoundaryLink> links(const Patch& now, std::uint64_t patch) const;
  /// Reports all sites with triangles that are all known, if the patch has changed anything about them.
  std::vector<SiteVerdict> verdicts(const Patch& now, double bad_alpha);

private:
  static void find_worst(const Patch& patch, double bad_alpha, std::vector<double>& worst);
  bool is_news(const Patch& now, LocalIndex v) const;
  bool is_new(LocalIndex v) const { return v >= start_.vertices(); }
  BoundaryName site_before(const Patch& now, LocalIndex v) const;
  BoundaryName name(const Patch& now, LocalIndex v, std::uint64_t patch) const;

  const PatchStart& start_;
  const PatchRests& rests_;
  std::vector<double> worst_before_, worst_after_; // by vertex: alpha of its worst triangle if that is bad, else 0
};

/// @brief Chooses the triangle of a patch that is improved next. Triangles are identified by their corners, from the
/// largest index on, so that the way in which the triangulation stores them does not matter.
class PatchWorst {
public:
  /// References must outlive the object.
  PatchWorst(const PatchStart& start, const PatchRests& rests) : start_(start), rests_(rests) {}

  /// @brief Nothing has been tried; triangles above a limit are wanted.
  void begin(double above) {
    above_ = above;
    tried_.clear();
    forget();
  }
  /// Notes that the patch has changed: its triangles are listed again when they are needed.
  void forget() { is_listed_ = false; }

  /// The worst triangle that has not been tried and does not rest.
  std::optional<Corners> next(const Patch& now);
  /// @param corners as next() gives them
  void set_tried(const Corners& corners) { tried_.push_back(corners); }
  bool is_tried(const Corners& corners) const;

private:
  struct BadTriangle {
    Corners corners;
    double alpha;
  };
  static Corners largest_first(Corners corners);
  void list(const Patch& now);

  const PatchStart& start_;
  const PatchRests& rests_;
  double above_ = 0; // alpha
  std::vector<Corners> tried_;
  std::vector<BadTriangle> bad_;
  bool is_listed_ = false;
};

/// @brief Aspect ratios that are computed again only where vertices have moved or edges have been flipped: the same
/// bits as Patch::alpha, without most of its roots.
class KnownAlphas {
public:
  /// Another patch, or another number of vertices, comes next.
  void forget() {
    places_.clear();
    known_.clear();
    time_ = 0;
  }
  /// @brief The patch may have moved. O(vertices). To be called before `alpha`.
  void follow(const Patch& patch) {
    const auto vertices = at(patch.mesh.vertices());
    has_moved_.assign(vertices, 1);
    for (std::size_t v = 0; v < places_.size(); ++v)
      has_moved_[v] = patch.mesh.position(static_cast<LocalIndex>(v)) != places_[v];
    places_.resize(vertices);
    for (std::size_t v = 0; v < vertices; ++v)
      places_[v] = patch.mesh.position(static_cast<LocalIndex>(v));
    known_.resize(patch.mesh.triangles().size(), {{-1, -1, -1}, 0, 1});
    ++time_;
  }
  /// Returns alpha of a triangle of the patch.
  double alpha(const Patch& patch, const PatchMesh::Triangle& triangle) {
    const auto& [a, b, c] = triangle.vertex;
    Known& known = known_[static_cast<std::size_t>(&triangle - patch.mesh.triangles().data())];
    if (known.vertex != triangle.vertex || known.time + 1 < time_ ||
        (has_moved_[at(a)] | has_moved_[at(b)] | has_moved_[at(c)]) != 0)
      known = {triangle.vertex, time_, patch.alpha(triangle.vertex)};
    known.time = time_;
    return known.alpha;
  }

private:
  struct Known {
    Corners vertex;
    int time; // when it was asked for the last time
    double alpha;
  };
  int time_ = 0;                        // counts the calls of follow
  std::vector<geometry::Vec2> places_;  // by vertex: the positions that `known_` was computed from
  std::vector<std::uint8_t> has_moved_; // by vertex, since then
  std::vector<Known> known_;            // by triangle
};

/// @brief Improves all triangles around a place: first by moves of the sites of bad ones, then, from the worst one on,
/// by insertions and deletions followed by such moves; where nothing else helps, by smaller triangles. Sites on the
/// boundary that are no corners take part: they slide along their curve, come and go.
///
/// Moves alone would only spread what is wrong around a very bad triangle over many others. There an insertion or a
/// deletion comes first if with moves it is better than the same moves alone.
///
/// The rules are those of PatchContest, PatchMover and PatchChords. Only + - * / sqrt and exact predicates inside: the
/// result is a pure function of the sites.
class PatchOptimizer {
public:
  /// See PatchStart.
  PatchOptimizer(const polygon::BoundarySites& boundary, const polygon::BoundaryCurve& curve,
                 const geometry::Lattice& lattice, const PatchOptions& options)
      : options_(options), start_(boundary, curve, lattice), chords_(start_), mover_(start_, chords_),
        worst_(start_, rests_), contest_(start_, chords_, mover_, options), report_(start_, rests_),
        now_(start_.patch()), best_(start_.patch()) {}
  PatchOptimizer(const PatchOptimizer&) = delete; // its parts refer to each other
  PatchOptimizer& operator=(const PatchOptimizer&) = delete;

  /// @brief Tries everything once.
  /// @param size h at the center
  /// @param sites in lexicographic order, all different; all that lie within CleanupRules::reach times `size` of
  ///        `center`
  /// @param patch a number that no other patch has: new sites on the boundary are called after it
  PatchResult improve(geometry::Vec2 center, double size, std::span<const PatchSite> sites, const PatchBudget& budget,
                      std::uint64_t patch = 0);

private:
  PatchResult give_up(std::span<const PatchSite> sites) const;
  void operate_first(const PatchBudget& budget);
  void operate(const PatchBudget& budget);
  bool try_at(const Corners& worst, const PatchBudget& budget, PatchContest::Turn turn);
  bool is_settled(const Corners& corners) const;
  void let_failures_rest();
  void move_bad_sites();
  bool list_movers(AlphaScore& score);
  bool mark_bad(AlphaScore& score);

  PatchOptions options_;
  PatchStart start_;
  PatchChords chords_;
  PatchMover mover_;
  PatchRests rests_;
  PatchWorst worst_;
  PatchContest contest_;
  PatchReport report_;
  Patch now_, best_;
  KnownAlphas alphas_;
  std::vector<std::uint8_t> mark_; // by vertex
  std::vector<LocalIndex> movers_; // sites of bad triangles, and their neighbours
};

} // namespace trime::cleanup
