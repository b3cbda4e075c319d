// SPDX-License-Identifier: BSD-3-Clause
// The surroundings of a bad triangle and the changes that are tried there. One thread; knows nothing of ranks.
#pragma once

#include "meshing/boundary_curve.hpp"
#include "meshing/patch_mesh.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/periods.hpp"
#include "trime/mesh/binned_points.hpp"
#include "trime/meshing/boundary_guard.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trime::meshing {

/// A site near the bad triangle, at that image of it which lies there.
struct PatchSite {
  geometry::Vec2 position;
  double size;           ///< h there
  std::int32_t boundary; ///< see mesh::Site
  double tolerance = 0;  ///< on the boundary: how far a new chord may pass from a curve with corners between
};

/// What becomes of a site: where it goes, or that it is deleted; or a new site (`from` says nothing then); or that
/// nothing helps there.
struct SiteEdit {
  enum class Kind : std::int32_t { move, remove, insert, none };
  geometry::Vec2 from, to;
  Kind kind = Kind::move;
  std::int32_t boundary = mesh::free_site; ///< index of the boundary site; for a new one, of the site before it
  double arc = 0;                          ///< of the new place on the boundary; none: h at the middle, else 0
  std::uint64_t patch = 0;                 ///< set by who collects them
};

/// What is tried, and when it is kept.
struct PatchOptions {
  /// h at the middle: nothing changes within it from the rim of what is read, so a patch may begin that much nearer.
  static constexpr double clearance = 2.8;
  double reach = 6; ///< sites within this many h of the middle are read
  /// A hexagonal lattice has 130 there. Where the boundary crowds many more, as in spikes far below h, nothing is
  /// tried.
  std::size_t most_sites = 500;
  double bad_alpha = 1.07; ///< triangles above it are bad
  /// Insertions and deletions are tried where moves alone leave a triangle above it, or help nothing.
  double operate_alpha = 1.09;
  int trial_sweeps = 6;      ///< over the free sites after an operation
  std::size_t finalists = 4; ///< operations that go beyond the first sweeps, near the middle
  double tolerance = 0;      ///< of PatchSite, in sizes as they are asked for
};

/// What a patch may do with the number of sites.
struct PatchBudget {
  GlobalId may_insert = 100; ///< so many more than it deletes
  GlobalId may_delete = 2;
  double deletion_handicap = 1; ///< factor on the sum of a trial with fewer sites: above 1 if sites are scarce
};

/// @brief Improves the triangles around a place by moving the free sites near it, and by insertions and deletions
/// followed by such moves; where nothing else helps, by smaller triangles. Sites on the boundary that are no corners
/// take part: they slide along their curve, come and go.
///
/// A trial counts as better if the sum over the triangles of (alpha - 1)^2, bad ones weighing more, falls by 2 % at
/// least and the largest alpha does not rise; one with smaller triangles if the largest alpha falls by a tenth of its
/// excess. Moves lower the StarEnergy of one site after the other by Newton steps.
/// Nobody enters the diametral disc of a boundary segment, and no segment comes to stand for a curve that leaves its
/// disc, or that turns by more than 60 degrees and strays by more than the tolerance. Only + - * / sqrt and exact
/// predicates inside: a pure function of the sites.
class PatchOptimizer {
public:
  PatchOptimizer(const BoundarySites& boundary, const BoundaryCurve& curve, const BoundaryGuard& guard,
                 const geometry::Lattice& lattice, const PatchOptions& options)
      : boundary_(boundary), curve_(curve), guard_(guard), lattice_(lattice), options_(options),
        base_(lattice, boundary.periods), trial_(base_), best_(base_), finalists_(options.finalists, Finalist{base_}) {}

  /// @brief Tries everything once.
  /// @param sites in lexicographic order; all that lie within `options.reach` times `size` of `center`
  /// @param edits receives the changes, if one was better; else Kind::none for the center and the corners of the bad
  /// triangle
  /// @return whether one was
  bool improve(geometry::Vec2 center, double size, std::span<const PatchSite> sites, const PatchBudget& budget,
               std::vector<SiteEdit>& edits);

private:
  enum class Role : std::uint8_t { gone, held, scored, free }; // scored: held, but its triangles count
  struct Score {
    double sum = 0, max = 1;
  };
  struct Operation {
    std::array<LocalIndex, 2> removed{-1, -1};   // vertices
    std::array<LocalIndex, 2> divided{-1, -1};   // chords of the boundary, by the vertex where they begin
    std::optional<geometry::Vec2> inserted = {}; // inside
    bool inserts() const { return divided[0] >= 0 || inserted; }
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

    PatchMesh mesh;
    std::vector<Role> role;
    std::vector<double> size;
    std::vector<BoundaryVertex> boundary;
    bool broken = false;
    bool divided = false; // chords were: the guard knows larger discs
  };
  struct Finalist {
    Patch patch;
    double sum = 0, handicap = 1;
  };
  struct Best {     // among the trials of a patch
    double first;   // sum that a trial had to fall below at first
    double least;   // and now
    double before;  // largest alpha at the beginning
    double largest; // now
    bool found = false;
  };
  static std::size_t at(LocalIndex v) { return static_cast<std::size_t>(v); }

  bool build(geometry::Vec2 center, double size, std::span<const PatchSite> sites);
  void link_boundary();
  bool counts(const Patch& patch, const PatchMesh::Triangle& triangle) const;
  bool lies_inside(const Patch& patch, const PatchMesh::Triangle& triangle) const;
  Score score(const Patch& patch) const;
  const PatchMesh::Triangle* worst_triangle() const;
  void list_operations();
  void list_at_boundary(const PatchMesh::Triangle& worst);
  bool is_within(const PatchBudget& budget) const;
  bool apply(const Operation& operation);
  bool remove(LocalIndex v);
  void try_refining(const PatchBudget& budget, Best& best);
  bool refine();
  bool divide_where_encroached();
  bool is_clear(const Patch& patch, geometry::Vec2 p, double h) const;
  bool is_within_reach(geometry::Vec2 p, double h) const;
  bool insert(geometry::Vec2 place);
  bool insert_on_boundary(LocalIndex before);
  double begin_trial(double handicap, const Best& best);
  void finish_trial(Patch& trial, double handicap, Best& best);
  void enter_finals(double sum, double handicap);
  void try_everything(const PatchBudget& budget, Best& best);
  void relax(Patch& patch, int sweeps, double radius);
  void relax_vertex(Patch& patch, LocalIndex v);
  void slide_vertex(Patch& patch, LocalIndex v);
  bool stands_for_curve(const BoundaryVertex& from, const BoundaryVertex& to, const geometry::Segment& chord,
                        double size) const;
  bool leaves_discs_empty(const Patch& patch, LocalIndex v, geometry::Vec2 to) const;
  bool is_crossed(const Patch& patch) const;
  bool chords_hold(const Patch& patch) const;
  void collect_edits(std::vector<SiteEdit>& edits) const;

  const BoundarySites& boundary_;
  const BoundaryCurve& curve_;
  const BoundaryGuard& guard_;
  geometry::Lattice lattice_;
  PatchOptions options_;
  Patch base_, trial_, best_;
  std::vector<Finalist> finalists_; // by sum; infinite: none
  geometry::Vec2 center_;
  double size_ = 1;
  double longest_bent_ = 1;       // h: limit of chords of curves, in the present trials
  mutable bool too_long_ = false; // a chord failed only by this limit
  std::vector<Operation> operations_;
  std::vector<LocalIndex> ring_;
  std::vector<geometry::Vec2> around_;
};

} // namespace trime::meshing
