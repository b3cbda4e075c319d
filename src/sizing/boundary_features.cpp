// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/boundary_features.hpp"

#include "comm/agree.hpp"
#include "core/angle.hpp"
#include "core/thread_loop.hpp"
#include "sizing/piece_locator.hpp"
#include "sizing/rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::sizing {

using geometry::Vec2;

namespace {

constexpr int most_shrinks = 50;

double signed_turn(Vec2 before, Vec2 after) {
  return angle_of(cross(before, after), dot(before, after));
}

Vec2 turned(Vec2 v, double angle) {
  const SinCos t = sin_cos(angle);
  return {t.cos * v.x - t.sin * v.y, t.sin * v.x + t.cos * v.y};
}

/// Where a ball through the origin touches, seen from there.
struct Contact {
  Vec2 chord;
  double radius;
};

/// Returns the ball that touches the inside of a segment, with its centre on the ray from the origin along `normal`, or
/// nothing.
std::optional<Contact> contact_with(Vec2 a, Vec2 b, Vec2 normal) {
  const Vec2 d = b - a;
  const double squared = squared_length(d);
  if (!(squared > 0))
    return std::nullopt;
  Vec2 to_origin = (1 / std::sqrt(squared)) * left_normal(d); // unit normal of the segment
  double distance = -dot(a, to_origin);
  if (distance < 0) {
    distance = -distance;
    to_origin = -1 * to_origin;
  }
  const double radius = distance / (1 - dot(normal, to_origin));
  const Vec2 chord = radius * (normal - to_origin);
  const double place = dot(chord - a, d);
  return distance > 0 && place > 0 && place < squared ? std::optional(Contact{chord, radius}) : std::nullopt;
}

} // namespace

void append_rays(Vec2 p, Vec2 tangent, std::vector<NormalRay>& rays) {
  const Vec2 normal = left_normal(tangent);
  rays.push_back({p, normal, 0});
  rays.push_back({p, -1 * normal, 1});
}

void append_rays(Vec2 p, Vec2 before, Vec2 after, std::vector<NormalRay>& rays) {
  const double turn = signed_turn(before, after);
  if (std::fabs(turn) < SizingRules::straight)
    return append_rays(p, turned(before, 0.5 * turn), rays);
  const Vec2 normal = turn < 0 ? left_normal(before) : -1 * left_normal(before); // to the side of the fan
  const int steps = static_cast<int>(std::ceil(std::fabs(turn) / SizingRules::fan_step));
  for (int k = 0; k <= steps; ++k)
    rays.push_back({p, turned(normal, turn * k / steps), turn < 0 ? 0 : 1});
  rays.push_back({p, turned(-1 * normal, 0.5 * turn), turn < 0 ? 1 : 0});
}

bool axis_ends_at(Vec2 before, Vec2 after) {
  return std::fabs(signed_turn(before, after)) >= separation_degrees * degrees * (1 - 1e-9);
}

std::optional<Vec2> medial_point(const NormalRay& ray, const PieceLocator& boundary, const Images& images,
                                 double& radius) {
  const geometry::Box& container = images.container();
  const double largest = geometry::length(container.max - container.min), smallest = 1e-12 * largest;
  const auto center_of = [&](double of) { return ray.origin + of * ray.normal; };
  const auto nearest = [&](double of) {
    return boundary.nearest(images.wrap(center_of(of)), SizingRules::empty_share * of);
  };
  radius = std::min(radius, largest);
  std::optional<PieceLocator::Nearest> near = nearest(radius);
  for (; !near && radius < largest; near = nearest(radius))
    radius = std::min(largest, SizingRules::first_growth * radius);
  // The ball before the last, unless it sees the boundary at a small angle only.
  std::optional<Vec2> found;
  bool touches = false;
  for (int round = 0; round < most_shrinks; ++round, near = nearest(radius)) {
    const Vec2 center = center_of(radius), wrapped = images.wrap(center);
    if (touches && (!near || length(near->point - wrapped) >= SizingRules::nearly_empty_share * radius))
      found = wrapped;
    if (!near)
      break;
    const Vec2 shift = center - wrapped - ray.origin, chord = near->point + shift;
    const double along = dot(chord, ray.normal), squared = squared_length(chord);
    if (!(along > 0) || squared <= smallest * smallest)
      break;
    const Contact contact = contact_with(near->segment_start + shift, near->segment_end + shift, ray.normal)
                                .value_or(Contact{chord, 0.5 * squared / along});
    radius = std::min(radius, contact.radius);
    touches = squared_length(contact.chord) >= radius * radius; // so long a chord is seen at 60 degrees from the centre
  }
  return found && images.in_container(*found) ? found : std::nullopt;
}

using cones::Cone;
using cones::ConeTree;
using geometry::Box;
using geometry::Piece;
using geometry::Vec2;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t ray_run = 64;
constexpr std::ptrdiff_t origins_in_a_row = 256; // of rays, by one thread
constexpr int most_rounds = 40;

/// All images within reach.
std::vector<Cone> with_images(const std::vector<Cone>& cones, const Images& images) {
  std::vector<Cone> all;
  for (const Vec2 shift : images.shifts())
    for (const Cone& cone : cones) {
      const Vec2 apex = cone.apex + shift;
      if (images.in_reach({apex, apex}))
        all.push_back({apex, cone.height});
    }
  return all;
}

/// Leaves out cones that the last one kept covers, or misses by a small share only: neighbours on the boundary are
/// mostly neighbours in the list.
std::vector<Cone> thinned(const std::vector<Cone>& cones, double slope) {
  std::vector<Cone> kept;
  for (const Cone& cone : cones)
    if (kept.empty() || kept.back().value(cone.apex, slope) > (1 + SizingRules::thinning_error) * cone.height)
      kept.push_back(cone);
  return kept;
}

/// Halves the boundary where the local feature size asks for it, round by round; each round's samples bring new medial
/// points, which lower the local feature sizes.
class Sampler {
public:
  Sampler(const comm::Communicator& comm, const geometry::Boundary& boundary, const Images& images, double floor,
          double slope)
      : comm_(comm), boundary_(boundary), images_(images), floor_(floor), slope_(slope), locator_(boundary, images) {}

  /// Samples with local feature sizes, not yet bounded.
  std::vector<Cone> run() {
    place_first();
    for (int round = 0; round < most_rounds && !origins_.empty(); ++round) {
      find_medial_points();
      update_feature_sizes();
      refine();
    }
    fill_in();
    update_feature_sizes();
    return std::move(samples_);
  }

private:
  /// Part of a piece between two neighbouring samples.
  struct Interval {
    const Piece* piece;
    double from, to; ///< arc lengths
    LocalIndex first, last;
  };

  /// Where rays begin: on a piece, or at its start if `before` is the piece that ends there.
  struct Origin {
    const Piece *before, *piece;
    double along;
    bool with_rays; ///< a vertex without a sample may still be the end of an axis
  };

  void place_first() {
    const double longest =
        std::max(images_.container().width(), images_.container().height()) / SizingRules::first_samples;
    std::size_t pieces = 0;
    for (const geometry::Loop& loop : boundary_.loops)
      pieces += loop.pieces.size();
    origins_.reserve(pieces);
    for (const geometry::Loop& loop : boundary_.loops) {
      const auto loop_start = static_cast<LocalIndex>(samples_.size());
      const std::vector<bool> kept = kept_vertices(loop);
      for (std::size_t k = 0; k < loop.pieces.size(); ++k) {
        const Piece& piece = loop.pieces[k];
        LocalIndex first = add_vertex(k > 0 ? loop.pieces[k - 1] : loop.pieces.back(), piece, kept[k]);
        const bool closes = k + 1 == loop.pieces.size();
        if (!kept[k] || !(closes || kept[k + 1]))
          continue; // shorter than any interval that is divided
        const double length = piece.length(), parts = std::max(1.0, std::ceil(length / longest));
        for (double part = 1; part <= parts; ++part) {
          const double from = length * ((part - 1) / parts), to = length * (part / parts);
          const LocalIndex last = part < parts ? add_sample(piece, to)
                                  : closes     ? loop_start
                                               : static_cast<LocalIndex>(samples_.size());
          intervals_.push_back({&piece, from, to, first, last});
          first = last;
        }
      }
    }
  }

  /// Which pieces start with a sample: of runs of short pieces only some.
  std::vector<bool> kept_vertices(const geometry::Loop& loop) const {
    const double shortest = std::min(SizingRules::sample_spacing, 2 * SizingRules::envelope_error / slope_) * floor_;
    std::vector<bool> kept(loop.pieces.size(), true);
    double since = loop.pieces.front().length(); // the last that was kept
    for (std::size_t k = 1; k < kept.size(); ++k) {
      const double length = loop.pieces[k].length();
      kept[k] = since + length > shortest;
      since = kept[k] ? length : since + length;
    }
    return kept;
  }

  /// Returns the sample, or the last before a vertex without one.
  LocalIndex add_vertex(const Piece& before, const Piece& after, bool with_sample) {
    origins_.push_back({&before, &after, 0, with_sample});
    if (with_sample)
      samples_.push_back({after.start, infinity});
    return static_cast<LocalIndex>(samples_.size()) - 1;
  }
  LocalIndex add_sample(const Piece& piece, double along, double most = infinity) {
    origins_.push_back({nullptr, &piece, along, true});
    samples_.push_back({piece.point(along), most});
    return static_cast<LocalIndex>(samples_.size()) - 1;
  }

  /// Appends its rays. Does an axis end there?
  static bool append_rays_from(const Origin& origin, std::vector<NormalRay>& rays) {
    const Piece& piece = *origin.piece;
    const Vec2 p = piece.point(origin.along), out = piece.tangent(origin.along);
    if (!origin.before) {
      append_rays(p, out, rays);
      return false;
    }
    const Vec2 in = origin.before->tangent(origin.before->length());
    if (origin.with_rays)
      append_rays(p, in, out, rays);
    return axis_ends_at(in, out);
  }

  /// The local feature size changes by no more than the distance.
  double upper_bound(const Interval& interval, double along) const {
    return std::min(samples_[interval.first].height + (along - interval.from),
                    samples_[interval.last].height + (interval.to - along));
  }

  void find_medial_points() {
    struct Found {
      Vec2 point;
      bool there;
    };
    std::vector<char> ends_axis(origins_.size());
    const std::vector<NormalRay> rays = gather_in_order<NormalRay>(
        std::ssize(origins_), origins_in_a_row, [&](std::ptrdiff_t k, std::vector<NormalRay>& list) {
          const auto at = static_cast<std::size_t>(k);
          ends_axis[at] = append_rays_from(origins_[at], list);
        });
    const double first_radius = std::max(floor_, SizingRules::first_radius * images_.container().width());
    const auto find_run = [&](std::size_t first, std::size_t last, Found* found) {
      std::array<double, 2> radius{first_radius, first_radius}; // to the left and to the right
      for (std::size_t k = first; k < last; ++k) {
        double& start = radius[rays[k].side];
        const std::optional<Vec2> point = medial_point(rays[k], locator_, images_, start);
        start = std::max(floor_, SizingRules::radius_growth * start);
        *found++ = {point.value_or(Vec2{}), point.has_value()};
      }
    };
    const std::vector<Found> found = comm::compute_shared_runs<Found>(comm_, rays.size(), ray_run, find_run);
    std::vector<Cone> points;
    for (std::size_t k = 0; k < origins_.size(); ++k)
      if (ends_axis[k])
        points.push_back({images_.wrap(origins_[k].piece->start), 0});
    origins_.clear();
    for (const Found& one : found)
      if (one.there)
        points.push_back({one.point, 0});
    medial_trees_.emplace_back(with_images(points, images_), 1.0);
  }

  /// Old samples have not seen the newest medial points, new samples none.
  void update_feature_sizes() {
    const std::vector<double> sizes = comm::compute_shared<double>(comm_, samples_.size(), [&](std::size_t k) {
      const Vec2 p = images_.wrap(samples_[k].apex);
      double size = samples_[k].height;
      std::size_t tree = k < known_ ? medial_trees_.size() - 1 : 0;
      for (; tree < medial_trees_.size() && size > floor_; ++tree)
        size = medial_trees_[tree].value(p, size, SizingRules::nearest_slack);
      return size;
    });
    for (std::size_t k = 0; k < sizes.size(); ++k)
      samples_[k].height = sizes[k];
    known_ = samples_.size();
  }

  void refine() {
    std::vector<Interval> next;
    for (const Interval& interval : intervals_) {
      const double size = std::min(samples_[interval.first].height, samples_[interval.last].height);
      if (interval.to - interval.from <= SizingRules::sample_spacing * std::max(size, floor_)) {
        next.push_back(interval);
        continue;
      }
      const double middle = 0.5 * (interval.from + interval.to);
      const LocalIndex sample = add_sample(*interval.piece, middle, upper_bound(interval, middle));
      next.push_back({interval.piece, interval.from, middle, interval.first, sample});
      next.push_back({interval.piece, middle, interval.to, sample, interval.last});
    }
    intervals_ = std::move(next);
  }

  /// Between two samples at distance d the envelope of their cones is too high by up to slope * d / 2.
  void fill_in() {
    for (const Interval& interval : intervals_) {
      const double size = std::max(std::min(samples_[interval.first].height, samples_[interval.last].height), floor_);
      const double length = interval.to - interval.from;
      const double parts = std::ceil(length * slope_ / (2 * SizingRules::envelope_error * size));
      for (double k = 1; k < parts; ++k) {
        const double along = interval.from + length * (k / parts);
        samples_.push_back({interval.piece->point(along), upper_bound(interval, along)});
      }
    }
  }

  const comm::Communicator& comm_;
  const geometry::Boundary& boundary_;
  const Images& images_;
  double floor_, slope_;
  PieceLocator locator_;
  std::vector<Cone> samples_;
  std::vector<Interval> intervals_;
  std::vector<Origin> origins_;        // of rays whose balls are not known yet
  std::vector<ConeTree> medial_trees_; // one for each round
  std::size_t known_ = 0;              // samples that have a local feature size
};

} // namespace

std::vector<Cone> boundary_features(const comm::Communicator& comm, const geometry::Boundary& boundary,
                                    const Images& images, double feature_floor, double gradation) {
  std::vector<Cone> cones = Sampler(comm, boundary, images, feature_floor, gradation).run();
  const double largest = images.container().width() + images.container().height();
  for (Cone& cone : cones)
    cone = {images.wrap(cone.apex), std::min(largest, std::max(feature_floor, cone.height))};
  cones = thinned(cones, gradation);
  const ConeTree all(with_images(cones, images), gradation);
  const std::vector<char> covered = comm::compute_shared<char>(comm, cones.size(), [&](std::size_t k) {
    return static_cast<char>(all.value(cones[k].apex, cones[k].height) < cones[k].height);
  });
  std::vector<Cone> kept;
  for (std::size_t k = 0; k < cones.size(); ++k)
    if (covered[k] == 0)
      kept.push_back(cones[k]);
  return with_images(kept, images);
}

} // namespace trime::sizing
