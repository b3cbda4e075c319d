// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/boundary_sizes.hpp"

#include "boundary/rules.hpp"
#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <atomic>

namespace trime::boundary {
namespace {

constexpr std::ptrdiff_t pieces_in_a_row = 64; // by one thread
constexpr std::size_t samples_in_a_row = 1024; // that are counted together

/// Names the piece with the most sites, as far as its start shows: the same piece on any threads.
[[noreturn]] void fail_for_samples(const geometry::Boundary& boundary, const sizing::SizeField& relative,
                                   const sizing::ScaledSize& asked) {
  double most = -1, h = 0;
  geometry::Vec2 place;
  for (const geometry::Loop& loop : boundary.loops)
    for (const geometry::Piece& piece : loop.pieces) {
      const double size = asked.scaled(sizing::checked_size(relative, boundary.periods.wrap(piece.start)));
      if (piece.length() / size > most) {
        most = piece.length() / size;
        h = size;
        place = piece.start;
      }
    }
  throw GeometryError(fmt::format("the element size near {} is {}: the boundary would get more than {} sites; "
                                  "ask for fewer points or a larger edge length",
                                  Place(place, 0), h, BoundaryRules::most_samples / 2));
}

} // namespace

SizeSamples::SizeSamples(const geometry::Boundary& boundary, const sizing::SizeField& relative,
                         const sizing::ScaledSize& asked)
    : factor_(asked.factor()) {
  std::atomic<std::size_t> total{0};
  for (const geometry::Loop& loop : boundary.loops) {
    OfLoop& of_loop = loops_.emplace_back();
    const auto pieces = std::ssize(loop.pieces);
    of_loop.samples =
        gather_in_order<Sample>(pieces, pieces_in_a_row, [&](std::ptrdiff_t i, std::vector<Sample>& list) {
          const geometry::Piece& piece = loop.pieces[static_cast<std::size_t>(i)];
          const double whole = piece.length();
          const std::size_t before = list.size();
          for (double s = 0;
               (s < whole || s == 0) && total.load(std::memory_order_relaxed) <= BoundaryRules::most_samples;) {
            const double value = sizing::checked_size(relative, boundary.periods.wrap(piece.point(s)));
            list.push_back({s, value, static_cast<LocalIndex>(i)});
            const double step = BoundaryRules::sample_step * asked.scaled(value);
            if (const std::size_t made = list.size() - before; made > 0 && made % samples_in_a_row == 0)
              total += samples_in_a_row;
            if (s + 1.25 * step >= whole)
              break; // the start of the next piece is near
            s += step;
          }
          total += (list.size() - before) % samples_in_a_row;
        });
    if (total > BoundaryRules::most_samples)
      fail_for_samples(boundary, relative, asked);
    of_loop.first.reserve(loop.pieces.size() + 1);
    for (std::size_t k = 0; k < of_loop.samples.size(); ++k)
      if (k == 0 || of_loop.samples[k].piece != of_loop.samples[k - 1].piece)
        of_loop.first.push_back(k);
    of_loop.first.push_back(of_loop.samples.size());
  }
}

double SizeSamples::at(std::size_t loop, LocalIndex piece, double along, double whole, Cursor& cursor) const {
  const OfLoop& of_loop = loops_[loop];
  const std::size_t first = of_loop.first[static_cast<std::size_t>(piece)],
                    last = of_loop.first[static_cast<std::size_t>(piece) + 1];
  std::size_t& k = cursor.index;
  if (k < first || k >= last || of_loop.samples[k].along > along)
    k = first;
  while (k + 1 < last && of_loop.samples[k + 1].along <= along)
    ++k;
  const Sample &low = of_loop.samples[k], &high = of_loop.samples[k + 1 < of_loop.samples.size() ? k + 1 : 0];
  const double end = k + 1 < last ? high.along : whole;
  const double share = end > low.along ? std::clamp((along - low.along) / (end - low.along), 0.0, 1.0) : 0;
  return low.relative + share * (high.relative - low.relative);
}

SizePair BoundarySizes::at(const PiecePlace& place, SizeSamples::Cursor& cursor) const {
  if (!sampled_) {
    const double size = sizing::checked_size(size_, place.canonical);
    return {size, &asked_ == &size_ ? size : sizing::checked_size(asked_, place.canonical)};
  }
  const double relative = sampled_->relative.at(place.loop, place.piece, place.along, place.whole, cursor);
  const double asked = sampled_->asked.scaled(relative);
  const double lowered = sampled_->lowered ? sampled_->lowered->lowered(place.canonical, asked) : asked;
  return {sampled_->coarsening * lowered, sampled_->coarsening * asked};
}

} // namespace trime::boundary
