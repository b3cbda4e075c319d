// SPDX-License-Identifier: BSD-3-Clause
// The surroundings of bad triangles and the changes that are tried there. One thread; knows nothing of ranks.
#pragma once

#include "meshing/boundary_chain.hpp"
#include "meshing/patch_mesh.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/periods.hpp"
#include "trime/mesh/binned_points.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trime::meshing {

/// A site near a bad triangle, at that image of it which lies there.
struct PatchSite {
  geometry::Vec2 position;
  double size;            ///< h there
  std::int32_t boundary;  ///< see mesh::Site
  std::int32_t rests = 0; ///< nothing helped here the last time
  double tolerance = 0;   ///< on the boundary: how far a new chord may pass from a curve with corners between
};

/// What becomes of a site: where it goes, or that it is deleted; or a new site (`from` says nothing then).
struct SiteEdit {
  geometry::Vec2 from, to;
  EditKind kind = EditKind::move;
  std::int32_t boundary = mesh::free_site; ///< index of the boundary site; for a new one, of the site before it
  double arc = 0;                          ///< of the new place on the boundary
  std::uint64_t patch = 0;                 ///< set by who collects them
};

/// What is known of a site after a patch has been tried.
struct SiteVerdict {
  geometry::Vec2 position; ///< as it is now
  double size;
  double alpha;       ///< of its worst triangle if that is bad, else 0
  std::int64_t rests; ///< nothing helped for its bad triangles, and it has not moved much since
};

/// What comes of a patch.
struct PatchResult {
  std::vector<SiteEdit> edits;       ///< empty if nothing was better
  std::vector<SiteVerdict> verdicts; ///< of the sites that have or had bad triangles, where something has changed
  int failures = 0;                  ///< bad triangles in the middle of the patch that stay
  bool put_off = false;              ///< set by who does not carry it out
};

/// What is tried, and when it is kept.
struct PatchOptions {
  /// h at the middle: nothing changes within it from the rim of what is read, so a patch may begin that much nearer.
  static constexpr double clearance = 2.8;
  double reach = 8; ///< sites within this many h of the middle are read
  /// A hexagonal lattice has 360 there. Where the boundary crowds many more, as in spikes far below h, nothing is
  /// tried.
  std::size_t most_sites = 600;
  double bad_alpha = 1.07; ///< triangles above it are bad
  /// Insertions and deletions are tried where moves alone leave a triangle above it.
  double operate_alpha = 1.09;
  double very_bad_alpha = 1.25; ///< more is tried for triangles above it
  double first_alpha = 1.35;    ///< operations come before moves for triangles above it
  double again_alpha = 1.15;    ///< above it patches are tried again; above less if the whole mesh is better
  int moving_sweeps = 8;        ///< over the sites of bad triangles and their neighbours
  int trial_sweeps = 3;      ///< at most, over the free sites around, of the best operations; twice as many if thorough
  std::size_t runners = 6;   ///< operations that go beyond the first sweep, near the middle
  std::size_t finalists = 4; ///< operations that go beyond the second
  double tolerance = 0;      ///< of PatchSite, in sizes as they are asked for
};

/// What a patch may do with the number of sites.
struct PatchBudget {
  GlobalId may_insert = 100; ///< so many more than it deletes
  GlobalId may_refine = 100; ///< the same where smaller triangles are the last resort
  GlobalId may_delete = 2;
  bool is_again = false;                           ///< whether the patch has been tried before
  double again_alpha = PatchOptions{}.again_alpha; ///< then operations are tried for triangles above it
  double deletion_handicap = 1; ///< factor on the sum of a trial with fewer sites: above 1 if sites are scarce
};

/// @brief Improves all triangles around a place: first by moves of the sites of bad ones, then, from the worst one on,
/// by insertions and deletions followed by such moves; where nothing else helps, by smaller triangles. Sites on the
/// boundary that are no corners take part: they slide along their curve, come and go.
///
/// Around a very bad triangle an insertion or a deletion comes before all moves if with moves it is better than moves
/// alone, which would only spread what is wrong over many triangles.
///
/// An operation counts as better if the sum over the triangles near it of (alpha - 1)^2, bad ones weighing more, falls
/// by 2 % at least and the largest alpha does not rise; one with smaller triangles if the largest alpha falls by a
/// hundredth of its excess. Moves lower the StarEnergy of one site after the other by Newton steps.
/// Nobody enters the diametral disc of a boundary segment, and no segment comes to stand for a curve that leaves its
/// disc, or that turns by more than 60 degrees and strays by more than the tolerance. Only + - * / sqrt and exact
/// predicates inside: a pure function of the sites.
class PatchOptimizer {
public:
  PatchOptimizer(const BoundaryChain& chain, const geometry::Lattice& lattice, const PatchOptions& options)
      : chain_(chain), boundary_(chain.sites()), curve_(chain.curve()), lattice_(lattice), options_(options),
        start_(lattice, boundary_.periods), now_(start_), trial_(start_), best_(start_),
        runners_(options.runners, Runner{start_}), finalists_(options.finalists, Runner{start_}) {}

  /// @brief Tries everything once.
  /// @param sites in lexicographic order, all different; all that lie within `options.reach` times `size` of `center`
  PatchResult improve(geometry::Vec2 center, double size, std::span<const PatchSite> sites, const PatchBudget& budget);

private:
  using Corners = std::array<LocalIndex, 3>;
  enum class Role : std::uint8_t { gone, held, scored, free }; // scored: held, but its triangles count
  struct Score {
    double sum = 0, max = 1;
  };
  struct Term { // of the sum of now_
    Corners vertex;
    LocalIndex triangle;
    double value;
  };
  struct Bad { // triangle
    Corners corners;
    double alpha;
  };
  struct Operation {
    std::array<LocalIndex, 2> removed{-1, -1};   // vertices
    std::array<LocalIndex, 2> divided{-1, -1};   // chords of the boundary, by the vertex where they begin
    std::optional<geometry::Vec2> inserted = {}; // inside
    bool inserts() const { return divided[0] >= 0 || inserted; }
    friend bool operator==(const Operation&, const Operation&) = default;
  };
  /// A vertex on the boundary: its neighbours along the loop, -1 beyond the patch, and its place.
  struct BoundaryVertex {
    std::int32_t site = mesh::free_site; // its index, or that of the last one before it that had one; -1: inside
    LocalIndex previous = -1, next = -1;
    LocalIndex loop = -1;
    double arc = 0;
    double tolerance = 0;
    bool changed = false; // the chord to the next is not what it was
  };
  /// A triangulation and what is known of its vertices.
  struct Patch {
    Patch(const geometry::Lattice& lattice, const geometry::Periods& periods) : mesh(lattice, periods) {}
    LocalIndex add(geometry::Vec2 p, double h, const BoundaryVertex& on_boundary, Role its_role);
    void append(LocalIndex v, double h, const BoundaryVertex& on_boundary, Role its_role);
    bool on_boundary(LocalIndex v) const { return boundary[at(v)].site >= 0; }
    bool is_chord(LocalIndex from, LocalIndex to) const { return boundary[at(from)].next == to; }
    /// Is it a triangle of sites, with one whose triangles count?
    bool may_count(const PatchMesh::Triangle& triangle) const {
      const auto& [a, b, c] = triangle.vertex;
      return std::min(a, std::min(b, c)) >= PatchMesh::frame &&
             std::max(role[at(a)], std::max(role[at(b)], role[at(c)])) >= Role::scored;
    }
    /// @pre it is a triangle of sites
    bool has_inner_vertex(const PatchMesh::Triangle& triangle) const {
      const auto& [a, b, c] = triangle.vertex;
      return !on_boundary(a) || !on_boundary(b) || !on_boundary(c);
    }

    PatchMesh mesh;
    std::vector<Role> role;
    std::vector<double> size;
    std::vector<BoundaryVertex> boundary;
    std::vector<LocalIndex> rim; // vertices on the boundary, gone ones included
    GlobalId gain = 0;           // of sites, since the start
    bool broken = false;
  };
  struct Runner { // a trial that is still in the contest
    Patch patch;
    double sum = 0, handicap = 1; // infinite: none
  };
  /// The place of the trials, and the best of them.
  struct Contest {
    Corners corners;
    geometry::Vec2 middle;
    double alpha;   // of the triangle
    double size;    // h there
    double first;   // sum that a trial has to fall below at first
    double least;   // and now
    double before;  // largest alpha at the beginning
    double largest; // now
    bool found = false;
  };
  static std::size_t at(LocalIndex v) { return static_cast<std::size_t>(v); }

  bool build(geometry::Vec2 center, double size, std::span<const PatchSite> sites);
  void link_boundary();
  /// Inside the shape, and with a vertex whose triangles count.
  static bool counts(const Patch& patch, const PatchMesh::Triangle& triangle) {
    return patch.may_count(triangle) && (patch.has_inner_vertex(triangle) || lies_inside(patch, triangle));
  }
  static bool lies_inside(const Patch& patch, const PatchMesh::Triangle& triangle);
  double alpha(const Patch& patch, const PatchMesh::Triangle& triangle) const;
  bool is_bad(const Patch& patch, const PatchMesh::Triangle& triangle) const;
  void add_to(Score& score, double alpha) const;
  geometry::Vec2 middle_of(const Patch& patch, const Corners& corners) const;
  bool is_in_core(geometry::Vec2 p) const;
  void collect_edits(std::vector<SiteEdit>& edits) const;
  void collect_verdicts(PatchResult& result);
  LocalIndex missing_chords(const Patch& patch) const;
  bool chords_hold(const Patch& patch) const;

  // patch_moves.cpp
  void move_bad_sites();
  bool mark_bad_sites(Score& score);
  void relax(Patch& patch, std::span<const LocalIndex> vertices);
  bool relax_vertex(Patch& patch, LocalIndex v);
  void slide_vertex(Patch& patch, LocalIndex v);
  bool stands_for_curve(const BoundaryVertex& from, const BoundaryVertex& to, const geometry::Segment& chord,
                        double size) const;
  bool keeps_clear(const Patch& patch, geometry::Vec2 to) const;
  bool leaves_discs_empty(const Patch& patch, LocalIndex v, geometry::Vec2 to) const;

  // patch_trials.cpp, patch_operations.cpp
  void operate_first(const PatchBudget& budget);
  void operate(const PatchBudget& budget);
  bool is_settled(const Corners& corners) const;
  static Corners largest_first(Corners corners);
  bool is_tried(const Corners& corners) const;
  bool rest(const Corners& corners) const;
  void wake_moved(const Patch& before);
  std::optional<Corners> worst_untried(double above);
  void list_bad(double above);
  bool try_at(const Corners& worst, const PatchBudget& budget, bool is_first);
  bool set_bar_by_moves(Contest& contest);
  void list_near(const Contest& contest);
  bool is_worth(const Contest& contest, double largest_near, const PatchBudget& budget) const;
  Score note_terms();
  double sum_near(const Patch& patch);
  Score score_near(const Patch& patch) const;
  void list_operations(const Contest& contest);
  void list_at_boundary(const Contest& contest);
  bool apply(const Operation& operation);
  bool remove(LocalIndex v);
  bool insert(geometry::Vec2 place);
  bool insert_on_boundary(LocalIndex before);
  std::optional<geometry::Segment> entered_disc(const Patch& patch, geometry::Vec2 p) const;
  bool is_within_reach(geometry::Vec2 p, double h) const;
  bool is_within(GlobalId may_insert, const PatchBudget& budget) const;
  void relax_near(Patch& patch, std::span<const LocalIndex> near);
  void run(Patch& patch, double handicap, double share, const Contest& contest, std::span<Runner> list);
  static void enter(std::span<Runner> list, Patch& patch, double sum, double handicap);
  int strain_added(const Operation& operation);
  void finish(Runner& finalist, Contest& contest);
  void try_everything(const PatchBudget& budget, Contest& contest);
  void try_refining(const PatchBudget& budget, Contest& contest);
  bool refine(const Corners& worst);
  bool divide_where_strayed();
  bool divide_where_encroached();
  bool is_behind(LocalIndex v);

  const BoundaryChain& chain_;
  const BoundarySites& boundary_;
  const BoundaryCurve& curve_;
  geometry::Lattice lattice_;
  PatchOptions options_;
  Patch start_, now_, trial_, best_;
  std::vector<Runner> runners_, finalists_; // by sum
  geometry::Vec2 center_;
  double size_ = 1;
  double place_size_ = 1;           // h at the place of the present trials
  LocalIndex missing_at_start_ = 0; // chords that are no edges
  bool is_thorough_ = false;        // the present trials are for a triangle that is worth many of them
  double longest_bent_ = 1;         // h: limit of chords of curves, in the present trials
  std::vector<Operation> operations_;
  std::vector<Corners> tried_; // very bad ones
  std::vector<LocalIndex> ring_, touched_, shifted_, movers_, nearest_,
      near_;                                                   // vertices: work space, and those to move
  std::vector<std::uint8_t> rests_, rested_, mark_, in_score_; // by vertex
  std::vector<double> worst_before_, worst_after_;             // by vertex: alpha
  std::vector<Term> terms_;                                    // of the triangles near the place of the trials
  std::vector<std::uint8_t> is_noted_;                         // by triangle of now_: whether it has a term
  std::vector<LocalIndex> other_;                              // triangles of a trial that are none of now_
  std::vector<Bad> bad_;                                       // triangles of now_ that operations are for
  bool bad_is_known_ = false;
  std::vector<geometry::Vec2> around_;
};

} // namespace trime::meshing
