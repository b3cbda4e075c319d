// SPDX-License-Identifier: BSD-3-Clause
// Tries changes around bad triangles. Runs on one thread and does not depend on the ranks.
#pragma once

#include "cleanup/patch.hpp"
#include "cleanup/patch_contest.hpp"

#include <optional>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief Reports the differences between a patch and its start.
class PatchReport {
public:
  /// The arguments must outlive the object.
  PatchReport(const PatchStart& start, const PatchRests& rests) : start_(start), rests_(rests) {}

  /// Returns the changes of the sites since the start. @param patch see PatchOptimizer::improve
  std::vector<SiteEdit> edits(const Patch& now, std::uint64_t patch) const;
  /// Returns the sites on the boundary whose place or next site has changed.
  std::vector<BoundaryLink> links(const Patch& now, std::uint64_t patch) const;
  /// Reports all sites whose triangles are all known, if the place of the site, its worst triangle or its rest has
  /// changed.
  std::vector<SiteVerdict> verdicts(const Patch& now, double bad_alpha);

private:
  struct Badness {           // how bad the triangles around a vertex are
    double alpha = 0;        // the largest alpha of these triangles if it is bad, otherwise 0
    std::int64_t obtuse = 0; // 1 if one of these triangles is obtuse
    friend bool operator==(const Badness&, const Badness&) = default;
  };
  static void find_worst(const Patch& patch, double bad_alpha, std::vector<Badness>& worst);
  bool is_news(const Patch& now, LocalIndex v) const;
  bool is_new(LocalIndex v) const { return v >= start_.vertices(); }
  BoundaryName site_before(const Patch& now, LocalIndex v) const;
  BoundaryName name(const Patch& now, LocalIndex v, std::uint64_t patch) const;

  const PatchStart& start_;
  const PatchRests& rests_;
  std::vector<Badness> worst_before_, worst_after_; // by vertex
};

/// @brief Chooses the triangle of a patch that is improved next. Triangles are identified by their corners, beginning
/// with the largest index, so the result does not depend on the order in which they are stored.
class PatchWorst {
public:
  /// The arguments must outlive the object.
  PatchWorst(const PatchStart& start, const PatchRests& rests) : start_(start), rests_(rests) {}

  /// @brief Begins a list of triangles above a limit that have not been tried.
  /// @param only_obtuse whether the list has only obtuse triangles
  void begin(double above, bool only_obtuse = false) {
    above_ = above;
    only_obtuse_ = only_obtuse;
    tried_.clear();
    forget();
  }
  /// Must be called after a change of the patch. Its triangles are listed again when next() needs them.
  void forget() { is_listed_ = false; }

  /// Returns the worst triangle that has not been tried and whose sites do not all rest.
  std::optional<Corners> next(const Patch& now);
  /// @param corners the corners that next() returned
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
  bool only_obtuse_ = false;
  std::vector<Corners> tried_;
  std::vector<BadTriangle> bad_;
  bool is_listed_ = false;
};

/// @brief Keeps the aspect ratios of triangles, and computes a ratio again only if its vertices have moved or an edge
/// was flipped. The ratios have the same bits as those of Patch::alpha; most need no square root.
class KnownAlphas {
public:
  /// Must be called before the object is used for another patch, or if the number of vertices has changed.
  void forget() {
    places_.clear();
    known_.clear();
    time_ = 0;
  }
  /// @brief Finds out which vertices of the patch have moved. Cost: O(vertices). Must be called before alpha().
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
  /// Returns the aspect ratio of a triangle of the patch.
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
    int time; // value of time_ when the ratio was last needed
    double alpha;
  };
  int time_ = 0;                        // number of calls of follow()
  std::vector<geometry::Vec2> places_;  // by vertex: position for which known_ was computed
  std::vector<std::uint8_t> has_moved_; // by vertex: whether the vertex has moved since then
  std::vector<Known> known_;            // by triangle: its ratio
};

/// @brief Improves all bad triangles around a place. First it moves their sites. Then, beginning with the worst
/// triangle, it tries insertions and deletions, each followed by such moves, and divides triangles where nothing else
/// improves them. Sites on the boundary take part unless they are corners: they move along their curve, and may be
/// inserted and removed.
///
/// Around a very bad triangle, moves alone would only make many other triangles worse. There an insertion or a deletion
/// comes first, if together with moves it gives better triangles than moves alone.
///
/// PatchContest, PatchMover and PatchChords define the rules. The class uses only + - * /, sqrt and exact predicates,
/// so the result depends only on the sites.
class PatchOptimizer {
public:
  /// See PatchStart.
  PatchOptimizer(const polygon::BoundarySites& boundary, const polygon::BoundaryCurve& curve,
                 const geometry::Lattice& lattice, const PatchOptions& options)
      : options_(options), start_(boundary, curve, lattice, options.ear_alpha), chords_(start_),
        mover_(start_, chords_), worst_(start_, rests_), contest_(start_, chords_, mover_, options),
        report_(start_, rests_), now_(start_.patch()), best_(start_.patch()) {}
  PatchOptimizer(const PatchOptimizer&) = delete; // members refer to each other
  PatchOptimizer& operator=(const PatchOptimizer&) = delete;

  /// @brief Tries all changes around a place once.
  /// @param size h at the center
  /// @param sites all sites within CleanupRules::reach times `size` of `center`, in lexicographic order; no two at the
  /// same place
  /// @param patch a number that no other patch has; the names of new sites on the boundary are computed from it
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
  std::vector<std::uint8_t> mark_; // work space, by vertex
  std::vector<LocalIndex> movers_; // sites of bad triangles, and their neighbours
};

} // namespace trime::cleanup
