// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/size_limits.hpp"

#include "boundary/rules.hpp"
#include "boundary/site_tree.hpp"
#include "comm/agree.hpp"
#include "core/thread_loop.hpp"
#include "geometry/cornered_boundary.hpp"
#include "polygon/both_sides.hpp"
#include "sizing/size_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace trime::boundary {

using geometry::Vec2;
using polygon::BoundarySites;

namespace {

// [h] Sites that are nearer to each other across the inside ask for a smaller size.
constexpr double narrow_gap = 0.65;

// [asked h] No limit of the size is lower, so that lowering ends in wedges.
constexpr double least_limit = 0.05;

// [asked h] The same where curves lie inside the shape: they are not simplified, and may pass each other much closer.
constexpr double least_limit_with_curves = 0.002;

// [chord lengths] Of the center of the circle that sees the chord at 75 degrees: 0.5 / tan(75 degrees).
constexpr double lens_offset = 0.134;

// [chord lengths] Radius of that circle: 0.5 / sin(75 degrees).
constexpr double lens_radius = 0.5176;

// [1] Size over the width of a channel: the side of an equilateral triangle over its height.
constexpr double width_factor = 1.15;

// [chords] Sites on the two arms of one sharp corner are near to each other at any size, and ask for no smaller one.
// The corner is searched among this number of chords on both sides.
constexpr int longest_arms = 24;

// [chords] The same where curves lie inside the shape: they may cross at a degree, and then their arms have this number
// of shells, and some chords more.
constexpr int longest_arms_with_curves = static_cast<int>(BoundaryRules::most_shells) + 6;

constexpr int sites_in_a_row = 64; // by one thread

/// Finds the limits of the chords [first, last).
class LimitFinder {
public:
  LimitFinder(const BoundarySites& boundary, const sizing::SizeField& size, const sizing::SizeField& asked,
              LocalIndex first, LocalIndex last)
      : boundary_(boundary), size_(size), asked_(asked), first_(first), last_(last),
        images_(boundary.inner.empty() ? std::vector<Vec2>{{0, 0}} : geometry::images_of(boundary.periods)),
        site_sizes_(sizes_at_sites()), tree_(items_near()), sharp_(boundary.sites.size()) {
    thread_loop(std::ssize(sharp_), sites_in_a_row, [this](std::ptrdiff_t k, int) {
      sharp_[static_cast<std::size_t>(k)] = chords_meet_sharply(static_cast<LocalIndex>(k));
    });
  }

  std::vector<sizing::SizeLimit> run() const {
    return gather_in_order<sizing::SizeLimit>(last_ - first_, sites_in_a_row,
                                              [&](std::ptrdiff_t k, std::vector<sizing::SizeLimit>& limits) {
                                                look(first_ + static_cast<LocalIndex>(k), limits);
                                              });
  }

private:
  /// At a site and at its chord.
  void look(LocalIndex k, std::vector<sizing::SizeLimit>& limits) const {
    const auto add = [&](Vec2 place, double limit, double h) {
      if (!(limit < BoundaryRules::least_lowering * h))
        return;
      limit = std::fmax(limit, least_limit_ * asked_.size(place));
      if (limit < BoundaryRules::least_lowering * h) // else it is as low already as it may become
        limits.push_back({place, limit});
    };
    const geometry::Segment chord = boundary_.chord(k);
    const double at_site = site_sizes_[static_cast<std::size_t>(k - first_)];
    add(chord.a, gap_across(k, narrow_gap * at_site), at_site);
    if (is_near_sharp(k))
      return; // in a wedge chords are short at any size
    const Vec2 middle = boundary_.periods.wrap(0.5 * (chord.a + chord.b));
    const double length = geometry::length(chord.b - chord.a), h = sizing::checked_size(size_, middle);
    const double limit = length < BoundaryRules::short_chord * h ? BoundaryRules::short_factor * length : h;
    add(middle, std::fmin(limit, width_factor * width_across(k, chord, length)), h);
  }

  std::vector<double> sizes_at_sites() const {
    std::vector<double> sizes(static_cast<std::size_t>(last_ - first_));
    sizing::loop_over_blocks(size_, std::ssize(sizes), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      std::vector<Vec2> places;
      for (std::ptrdiff_t k = begin; k < end; ++k)
        places.push_back(boundary_.sites[static_cast<std::size_t>(first_ + k)].position);
      std::ranges::copy(sizing::checked_sizes_at(size_, places), sizes.begin() + begin);
    });
    return sizes;
  }

  /// The sites that the circles of these chords may meet.
  std::vector<SiteTree::Entry> items_near() const {
    constexpr double lens = 0.5 + lens_offset + lens_radius; // [chord lengths] from an end
    constexpr double rounding = 1 + 1e-9;                    // must not hide a site
    geometry::Box box;
    for (LocalIndex k = first_; k < last_; ++k) {
      const geometry::Segment chord = boundary_.chord(k);
      const double reach = rounding * std::fmax(narrow_gap * site_sizes_[static_cast<std::size_t>(k - first_)],
                                                lens * geometry::length(chord.b - chord.a));
      box.include(chord.a - Vec2{reach, reach});
      box.include(chord.a + Vec2{reach, reach});
    }
    std::vector<SiteTree::Entry> items;
    for (std::size_t k = 0; k < boundary_.sites.size(); ++k)
      for (const Vec2 shift : images_)
        if (const Vec2 p = boundary_.sites[k].position + shift; box.contains(p))
          items.push_back({p, static_cast<LocalIndex>(k)});
    return items;
  }

  /// Least distance from the chord's line of the sites that see it at a large angle; infinite without any.
  double width_across(LocalIndex k, const geometry::Segment& chord, double length) const {
    const Vec2 along = (1 / length) * (chord.b - chord.a), inward{-along.y, along.x};
    const Vec2 center = 0.5 * (chord.a + chord.b) + lens_offset * length * inward;
    double width = std::numeric_limits<double>::infinity();
    tree_.for_each_within(center, lens_radius * length, [&](const SiteTree::Entry& item) {
      const double height = geometry::dot(item.position - chord.a, inward);
      if (height > 0 && height < width && !is_near(k, item.index) && !(has_curves_ && is_around_corner(k, item.index)))
        width = height;
    });
    return width;
  }

  LocalIndex next(LocalIndex k) const { return boundary_.sites[static_cast<std::size_t>(k)].next; }
  LocalIndex previous(LocalIndex k) const { return boundary_.sites[static_cast<std::size_t>(k)].previous; }

  /// Is one of the ends of chord k, or a neighbour of them, a sharp corner?
  bool is_near_sharp(LocalIndex k) const {
    return is_sharp(previous(k)) || is_sharp(k) || is_sharp(next(k)) || is_sharp(next(next(k)));
  }

  /// Distance from site k to the nearest other one across the inside, if below `reach`; else infinite.
  double gap_across(LocalIndex k, double reach) const {
    const geometry::Segment out = boundary_.chord(k);
    const Vec2 ahead = out.b - out.a, back = boundary_.chord(previous(k)).a - boundary_.chord(previous(k)).b;
    double gap = std::numeric_limits<double>::infinity();
    constexpr double rounding = 1 + 1e-12; // must not hide a nearer site
    tree_.for_each_nearer(out.a, reach, [&](const SiteTree::Entry& item) {
      const Vec2 across = item.position - out.a;
      const bool left_of_ahead = geometry::cross(ahead, across) > 0, right_of_back = geometry::cross(across, back) > 0;
      const bool inside =
          geometry::cross(ahead, back) > 0 ? left_of_ahead && right_of_back : left_of_ahead || right_of_back;
      if (const double distance = geometry::length(across);
          inside && distance < gap && !is_around_corner(k, item.index))
        gap = distance;
      return std::fmin(reach, rounding * gap);
    });
    return gap;
  }

  /// Are the sites at one place? A curve inside has a site on each side.
  bool is_at(LocalIndex k, LocalIndex other) const {
    return k == other || boundary_.sites[static_cast<std::size_t>(k)].position ==
                             boundary_.sites[static_cast<std::size_t>(other)].position;
  }

  /// Are the sites at most two chords apart, or on the arms of one sharp corner?
  bool is_around_corner(LocalIndex k, LocalIndex other) const {
    LocalIndex forward = k, backward = k;
    bool sharp_ahead = is_sharp(k), sharp_behind = sharp_ahead;
    for (int hop = 0; hop <= longest_arms_; ++hop) {
      if ((is_at(forward, other) && (hop <= 2 || sharp_ahead)) ||
          (is_at(backward, other) && (hop <= 2 || sharp_behind)))
        return true;
      forward = next(forward);
      backward = previous(backward);
      sharp_ahead |= is_sharp(forward);
      sharp_behind |= is_sharp(backward);
    }
    return false;
  }

  bool is_sharp(LocalIndex k) const { return sharp_[static_cast<std::size_t>(k)]; }

  /// Do the chords of site k meet at less than 60 degrees, on the inside?
  bool chords_meet_sharply(LocalIndex k) const {
    const geometry::Segment out = boundary_.chord(k),
                            in = boundary_.chord(boundary_.sites[static_cast<std::size_t>(k)].previous);
    const Vec2 ahead = out.b - out.a, back = in.a - in.b;
    const double dot = geometry::dot(ahead, back);
    return geometry::cross(ahead, back) > 0 && dot > 0 &&
           4 * dot * dot > geometry::squared_length(ahead) * geometry::squared_length(back);
  }

  /// Is the site at most two chords from chord k along the boundary?
  bool is_near(LocalIndex k, LocalIndex other) const {
    const auto& sites = boundary_.sites;
    const LocalIndex next = sites[k].next, previous = sites[k].previous;
    return is_at(other, k) || is_at(other, next) || is_at(other, previous) || is_at(other, sites[next].next);
  }

  const BoundarySites& boundary_;
  const sizing::SizeField &size_, &asked_;
  const LocalIndex first_, last_;
  const std::vector<Vec2> images_; // shifts by periods, if curves lie inside
  const bool has_curves_ = !boundary_.inner.empty();
  const double least_limit_ = has_curves_ ? least_limit_with_curves : least_limit;
  const int longest_arms_ = has_curves_ ? longest_arms_with_curves : longest_arms;
  const std::vector<double> site_sizes_; // of each of these chords, where it starts
  const SiteTree tree_;
  std::vector<char> sharp_; // for each site, whether its chords meet sharply
};

/// Lists limit k unless another of those next to it in the list implies it. What that one implies the limit that
/// implied it does, too.
void keep_unless_implied(std::span<const sizing::SizeLimit> limits, double gradation, std::ptrdiff_t k,
                         std::vector<sizing::SizeLimit>& kept) {
  constexpr std::ptrdiff_t neighbours = 32; // to each side
  const sizing::SizeLimit& limit = limits[static_cast<std::size_t>(k)];
  const std::ptrdiff_t last = std::min(std::ssize(limits), k + neighbours + 1);
  for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, k - neighbours); j < last; ++j) {
    const sizing::SizeLimit& other = limits[static_cast<std::size_t>(j)];
    const double reach = limit.size - other.size;
    if (reach > 0 && gradation * gradation * geometry::squared_length(limit.place - other.place) <= reach * reach)
      return;
  }
  kept.push_back(limit);
}

} // namespace

std::vector<sizing::SizeLimit> size_limits(const BoundarySites& boundary, const sizing::SizeField& size,
                                           const sizing::SizeField& asked, double gradation) {
  const auto chords = static_cast<LocalIndex>(boundary.sites.size());
  const std::vector<sizing::SizeLimit> all = LimitFinder(boundary, size, asked, 0, chords).run();
  return gather_in_order<sizing::SizeLimit>(
      std::ssize(all), sites_in_a_row,
      [&](std::ptrdiff_t k, std::vector<sizing::SizeLimit>& kept) { keep_unless_implied(all, gradation, k, kept); });
}

std::vector<sizing::SizeLimit> size_limits(const comm::Communicator& comm, const BoundarySites& given,
                                           const sizing::SizeField& size, const sizing::SizeField& asked,
                                           double gradation) {
  const BoundarySites sides = given.inner.empty() ? BoundarySites() : polygon::with_both_sides(given);
  const BoundarySites& boundary = given.inner.empty() ? given : sides;
  const auto chords = static_cast<std::int64_t>(boundary.sites.size());
  const auto share_of = [&](int rank) { return static_cast<LocalIndex>(chords * rank / comm.size()); };
  const std::vector<sizing::SizeLimit> all = comm::gather_agreed<sizing::SizeLimit>(
      comm, [&] { return LimitFinder(boundary, size, asked, share_of(comm.rank()), share_of(comm.rank() + 1)).run(); });
  return comm::gather_shared<sizing::SizeLimit>(
      comm, std::ssize(all), sites_in_a_row,
      [&](std::ptrdiff_t k, std::vector<sizing::SizeLimit>& kept) { keep_unless_implied(all, gradation, k, kept); });
}

} // namespace trime::boundary
