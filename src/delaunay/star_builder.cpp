// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/star_builder.hpp"

#include "core/thread_loop.hpp"
#include "delaunay/circumcenter.hpp"
#include "delaunay/star_kernel.hpp"
#include "delaunay/tile_wrapper.hpp"
#include "geometry/predicates.hpp"

#include <algorithm>
#include <cmath>

namespace trime::delaunay {
namespace {

using geometry::Vec2;

constexpr double first_window = 0.6; // [cap] A star from scratch first takes all sites in a window of this half-width
// [cap] Sites nearer than this are inserted before the others of that window: about the first ring.
constexpr double nearer_sites = 0.5;
// A window grows at most so much at a time, since each can shrink the radius that must be searched.
constexpr double window_growth = 1.6;
// [cap^2] A squared circumradius below this counts without its canonical value.
constexpr double surely_below_cap = 0.99;
// [periods] The largest cap, so that edges are shorter than half a period: a quarter, less a little.
constexpr double cap_in_period = 0.2499;

/// Searches are widened by this factor and two lattice steps, so that rounding in radii and window borders cannot lose
/// a site.
constexpr double inflation = 1 + 1e-9;

/// Squared circumradius from the vertices in lexicographic order of their canonical images: the same bits from each of
/// the three stars.
double canonical_squared_radius(Vec2 a, Vec2 b, Vec2 c, const geometry::Periods& periods) {
  if (periods.less(b, a))
    std::swap(a, b);
  if (periods.less(c, b)) {
    std::swap(b, c);
    if (periods.less(b, a))
      std::swap(a, b);
  }
  const Vec2 u = b - a, v = c - a;
  const double area = geometry::cross(u, v);
  return geometry::dot(u, u) * geometry::dot(v, v) * geometry::squared_length(u - v) / (4 * area * area);
}

/// All that one thread needs to compute stars one after the other.
class StarWorker {
public:
  StarWorker(const mesh::BinnedPoints& points, StarTable& stars, const geometry::Lattice& lattice)
      : points_(points), positions_(points.positions().data()), stars_(stars), lattice_(lattice),
        periods_(points.grid().periods()), slack_(2 * lattice.step()), kernel_(lattice, periods_) {}

  void compute(LocalIndex i, double cap) {
    site_ = i;
    cap_ = cap;
    center_ = positions_[i];
    changed_ = false;
    coincides_ = false;
    const bool warm = start_warm();
    const bool certain = warm ? finish(0, 0) : start_cold();
    pass_.uncertain += !certain;
    pass_.coincident += coincides_;
    stars_.set_certain(i, certain);
    if (!certain)
      stars_.clear(i);
    else if (!warm || changed_ || !is_stored_right())
      store();
  }

  const StarPass& pass() const { return pass_; }
  const std::vector<mesh::BinRef>& missing() const { return missing_; }

private:
  struct Candidate {
    double squared_distance;
    LocalIndex id;
  };

  Vec2 offset(LocalIndex i) const { return positions_[i] - center_; }
  bool lies_here(LocalIndex i) const { return positions_[i] == center_; }

  /// Takes up the last ring, if it has no gap and still is a star.
  bool start_warm() {
    ring_ = stars_.load(site_, ring_copy_);
    if (ring_.size() < 3 || std::find(ring_.begin(), ring_.end(), gap) != ring_.end())
      return false;
    return kernel_.start_ring(ring_, positions_, center_);
  }

  /// A star that kept its ring needs no new entry if all its triangles count and its first neighbour still is the
  /// smallest.
  bool is_stored_right() {
    return kernel_.squared_radius() < surely_below_cap * cap_ * cap_ && kernel_.smallest() == 0;
  }

  /// From the virtual square: the last ring first, then the sites nearby (about the first ring of neighbours, in any
  /// order), then all others; most of them lie beyond the security radius by then.
  bool start_cold() {
    kernel_.start_virtual(center_, lattice_.snap(2 * cap_) + lattice_.step());
    for (const LocalIndex neighbour : ring_)
      if (neighbour != gap && !lies_here(neighbour))
        kernel_.insert(neighbour, offset(neighbour));
    const double window = first_window * cap_;
    near_.clear();
    far_.clear();
    const std::size_t missing_before = missing_.size();
    points_.for_each_near(
        center_, window,
        [&](LocalIndex begin, LocalIndex end) { collect(begin, end, nearer_sites * nearer_sites * cap_ * cap_); },
        [&](mesh::BinRef bin) { missing_.push_back(bin); });
    for (const Candidate& c : near_)
      try_insert(c);
    for (const Candidate& c : far_)
      try_insert(c);
    const bool complete = missing_.size() == missing_before;
    return finish(window, window * window) && complete;
  }

  /// Sorts a run of sites into nearer and farther ones, without branches.
  void collect(LocalIndex begin, LocalIndex end, double limit) {
    std::size_t near = near_.size(), far = far_.size();
    const std::size_t n = static_cast<std::size_t>(end - begin);
    near_.resize(near + n);
    far_.resize(far + n);
    for (LocalIndex j = begin; j < end; ++j) {
      const double d2 = geometry::squared_length(offset(j));
      coincides_ |= (d2 == 0) & (j != site_);
      near_[near] = {d2, j};
      far_[far] = {d2, j};
      near += (d2 < limit) & (d2 > 0);
      far += d2 >= limit;
    }
    near_.resize(near);
    far_.resize(far);
  }

  void try_insert(const Candidate& c) {
    if (c.squared_distance < 4 * kernel_.squared_radius() && (ring_.empty() || !kernel_.contains(c.id)))
      changed_ |= kernel_.insert(c.id, offset(c.id));
  }

  /// Radius that must be searched: no site farther than 2 R_max, or than 2 cap, can change what counts.
  double needed() { return std::min(2 * std::sqrt(kernel_.squared_radius()), 2 * cap_) * inflation + slack_; }

  /// @brief Inserts what lies within the security radius, in windows that grow by window_growth at most
  /// (each window can shrink the radius); sites nearer than sqrt(done) have been inserted before.
  /// @return false if a bin within the radius is unknown
  bool finish(double searched, double done) {
    bool complete = true;
    while (searched < needed()) {
      const double reach = searched == 0 ? needed() : std::min(needed(), window_growth * searched);
      const std::size_t missing_before = missing_.size();
      if (searched == 0)
        check_members(reach);
      else
        insert_window(reach, done);
      complete = complete && missing_.size() == missing_before;
      searched = reach;
      done = reach * reach;
    }
    return complete;
  }

  /// For a warm star: sites within the security radius are counted first; if they are as many as the members within it,
  /// the star is right, and nobody's identity needs a look.
  void check_members(double reach) {
    // Both counts within the window: beyond it (a radius above the cap) members are known and other sites are not.
    const double r2 = std::min(4 * kernel_.squared_radius(), reach * reach);
    std::ptrdiff_t inside = -1; // the site itself
    const auto miss = [&](mesh::BinRef bin) { missing_.push_back(bin); };
    points_.for_each_near(
        center_, reach,
        [&](LocalIndex begin, LocalIndex end) {
          inside += count_within(positions_ + begin, positions_ + end, center_, r2);
        },
        miss);
    if (inside != kernel_.members_within(r2))
      points_.for_each_near(
          center_, reach, [&](LocalIndex begin, LocalIndex end) { insert_run(begin, end, 0); }, [](mesh::BinRef) {});
  }

  void insert_window(double reach, double done) {
    points_.for_each_near(
        center_, reach, [&](LocalIndex begin, LocalIndex end) { insert_run(begin, end, done); },
        [&](mesh::BinRef bin) { missing_.push_back(bin); });
  }

  void insert_run(LocalIndex begin, LocalIndex end, double done) {
    for (LocalIndex j = begin; j < end; ++j) {
      const double d2 = geometry::squared_length(offset(j));
      coincides_ |= (d2 == 0) & (j != site_);
      if (d2 > done && d2 < 4 * kernel_.squared_radius() && !kernel_.contains(j)) // runs overlap: j may be a member
        changed_ |= kernel_.insert(j, offset(j));
    }
  }

  /// Does the triangle between neighbours k and k+1 count?
  bool counts(std::size_t k) {
    const std::size_t next = k + 1 == kernel_.degree() ? 0 : k + 1;
    if (kernel_.id(k) < 0 || kernel_.id(next) < 0)
      return false;
    const double r2 = kernel_.squared_radius(k);
    if (r2 < surely_below_cap * cap_ * cap_)
      return true; // r2 is an upper bound
    return canonical_squared_radius(center_, points_.position(kernel_.id(k)), points_.position(kernel_.id(next)),
                                    periods_) < cap_ * cap_;
  }

  /// Writes the ring from its lexicographically smallest neighbour on, with gaps where triangles do not count.
  void store() {
    const std::size_t n = kernel_.degree();
    std::vector<LocalIndex>& ring = ring_copy_;
    ring.clear();
    std::size_t start = n;
    bool before = counts(n - 1);
    counted_.assign(n, 0);
    for (std::size_t k = 0; k < n; ++k) {
      const bool after = counts(k);
      counted_[k] = after;
      if ((before || after) &&
          (start == n || geometry::lexicographically_less(kernel_.offset(k), kernel_.offset(start))))
        start = k;
      before = after;
    }
    for (std::size_t m = 0, k = start; start < n && m < n; ++m, k = k + 1 == n ? 0 : k + 1) {
      const bool left = counted_[k == 0 ? n - 1 : k - 1], right = counted_[k];
      if (left || right)
        ring.push_back(kernel_.id(k));
      if (!right && (left || right))
        ring.push_back(gap);
    }
    const std::span<const LocalIndex> last = stars_.load(site_, last_ring_);
    pass_.rebuilt += !std::equal(ring.begin(), ring.end(), last.begin(), last.end());
    stars_.store(site_, ring);
  }

  const mesh::BinnedPoints& points_;
  const Vec2* positions_;
  StarTable& stars_;
  const geometry::Lattice& lattice_;
  geometry::Periods periods_;
  double cap_ = 0; // of the site
  double slack_;
  StarKernel kernel_;
  LocalIndex site_ = 0;
  Vec2 center_;
  StarPass pass_;
  std::vector<mesh::BinRef> missing_;
  bool changed_ = false, coincides_ = false; // coincides: another site has been found at the place of this one
  std::span<const LocalIndex> ring_;         // the last ring of the site
  std::vector<LocalIndex> ring_copy_, last_ring_;
  std::vector<Candidate> near_, far_;
  std::vector<std::uint8_t> counted_;
};

/// Collects the results of all workers.
template <class Worker>
StarPass collect(const PerThread<Worker>& workers, std::vector<mesh::BinRef>& missing) {
  StarPass pass;
  for (const Worker& worker : workers) {
    pass.computed += worker.pass().computed;
    pass.rebuilt += worker.pass().rebuilt;
    pass.uncertain += worker.pass().uncertain;
    pass.coincident += worker.pass().coincident;
    missing.insert(missing.end(), worker.missing().begin(), worker.missing().end());
  }
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  return pass;
}

void copy_ring(std::span<const LocalIndex> from, std::vector<LocalIndex>& to) {
  to.assign(from.begin(), from.end());
}

/// The members of two rings of a site that have other triangles with it in the one than in the other.
void list_affected(LocalIndex site, std::span<const LocalIndex> before, std::span<const LocalIndex> after,
                   std::vector<AffectedStar>& affected) {
  if (std::equal(before.begin(), before.end(), after.begin(), after.end()))
    return;
  const auto around = [](std::span<const LocalIndex> ring, std::size_t k) {
    return std::pair(ring[k == 0 ? ring.size() - 1 : k - 1], ring[k + 1 == ring.size() ? 0 : k + 1]);
  };
  const auto list = [&](std::span<const LocalIndex> ring, std::span<const LocalIndex> other, bool changed_too) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if (ring[k] == gap)
        continue;
      const auto found = std::find(other.begin(), other.end(), ring[k]);
      if (found == other.end() ||
          (changed_too && around(ring, k) != around(other, static_cast<std::size_t>(found - other.begin()))))
        affected.push_back({ring[k], site});
    }
  };
  list(before, after, true);
  list(after, before, false);
}

/// The stars of one tile after the other: many at once where that can be, the rest one by one.
class TileWorker {
public:
  TileWorker(const mesh::BinnedPoints& points, StarTable& stars, const geometry::Lattice& lattice)
      : points_(points), stars_(stars), star_(points, stars, lattice), wrapper_(points, stars, lattice, simd_level()) {}

  template <class Cap>
  void compute(LocalIndex tile, std::span<const StarWish> wanted, const Cap& cap) {
    const auto [begin, end] = points_.tile_range(tile);
    caps_.resize(static_cast<std::size_t>(end - begin));
    for (LocalIndex i = begin; i < end; ++i) {
      const StarWish wish = wanted.empty() ? StarWish::compute : wanted[static_cast<std::size_t>(i)];
      if (wish == StarWish::none)
        stars_.clear(i);
      if (wish != StarWish::compute)
        stars_.set_certain(i, false); // to be computed once it is wanted
      caps_[static_cast<std::size_t>(i - begin)] = wish == StarWish::compute && !stars_.certain(i) ? cap(i) : 0;
    }
    computed_ += std::ssize(caps_) - std::count(caps_.begin(), caps_.end(), 0.0);
    if (points_.drifts().largest().distance == 0) // it trusts the bins
      rebuilt_ += wrapper_.compute(tile, caps_);
    for (LocalIndex i = begin; i < end; ++i)
      if (const double limit = caps_[static_cast<std::size_t>(i - begin)]; limit > 0)
        star_.compute(i, limit);
  }

  StarPass pass() const {
    return {computed_, star_.pass().rebuilt + rebuilt_, star_.pass().uncertain, star_.pass().coincident};
  }
  const std::vector<mesh::BinRef>& missing() const { return star_.missing(); }

private:
  const mesh::BinnedPoints& points_;
  StarTable& stars_;
  StarWorker star_;
  TileWrapper wrapper_;
  std::vector<double> caps_;
  std::int64_t computed_ = 0, rebuilt_ = 0;
};

} // namespace

bool StarBuilder::counts(Vec2 a, Vec2 b, Vec2 c, double cap, const geometry::Periods& periods) {
  return canonical_squared_radius(a, b, c, periods) < cap * cap;
}

double StarBuilder::largest_cap(const geometry::Periods& periods) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return cap_in_period * std::min(periods.x > 0 ? periods.x : infinity, periods.y > 0 ? periods.y : infinity);
}

StarPass StarBuilder::update(const mesh::BinnedPoints& points, StarTable& stars, const mesh::LocalSizes& sizes,
                             std::span<const StarWish> wanted, std::vector<mesh::BinRef>& missing) const {
  PerThread<TileWorker> workers(points, stars, lattice_);
  const LocalIndex first_tile = points.first_tile();
  const double limit = largest_cap(points.grid().periods());
  thread_loop(points.last_tile() - first_tile, 1, [&](std::ptrdiff_t part, int thread) {
    const LocalIndex tile = first_tile + static_cast<LocalIndex>(part);
    workers[thread].compute(tile, wanted, [&](LocalIndex i) { return cap_at(sizes, i, limit); });
  });
  return collect(workers, missing);
}

StarPass StarBuilder::certify(const mesh::BinnedPoints& points, StarTable& stars, const mesh::LocalSizes& sizes,
                              std::span<const LocalIndex> sites, std::vector<AffectedStar>& affected,
                              std::vector<mesh::BinRef>& missing) const {
  struct Rings {
    std::vector<LocalIndex> before, after, room;
    std::vector<AffectedStar> affected;
  };
  PerThread<StarWorker> workers(points, stars, lattice_);
  PerThread<Rings> rings;
  const double limit = largest_cap(points.grid().periods());
  thread_loop(static_cast<std::ptrdiff_t>(sites.size()), 64, [&](std::ptrdiff_t k, int thread) {
    const LocalIndex i = sites[static_cast<std::size_t>(k)];
    Rings& r = rings[thread];
    copy_ring(stars.load(i, r.room), r.before);
    workers[thread].compute(i, cap_at(sizes, i, limit));
    copy_ring(stars.load(i, r.room), r.after);
    list_affected(i, r.before, r.after, r.affected);
  });
  for (const Rings& r : rings)
    affected.insert(affected.end(), r.affected.begin(), r.affected.end());
  StarPass pass = collect(workers, missing);
  pass.computed = std::ssize(sites);
  return pass;
}

} // namespace trime::delaunay
