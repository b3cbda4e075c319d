// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/boundary_guard.hpp"

#include "trime/core/error.hpp"
#include "trime/geometry/diametral.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {

using geometry::Segment;
using geometry::Vec2;

namespace {

constexpr double near_share = 0.05; // of the chord length: closer sites encroach
constexpr double push_share = 0.6;  // of the chord length, from its middle
constexpr double cells_per_chord = 64;
constexpr double most_cells = 0x1p22;
constexpr double most_entries = 0x1p25; // of all cell lists together

std::vector<Segment> chords_of(const BoundarySites& sites) {
  std::vector<Segment> chords;
  chords.reserve(sites.sites.size());
  for (const BoundarySite& site : sites.sites)
    chords.push_back({site.position, sites.sites[site.next].position});
  return chords;
}

/// Radius around the middle of the chord that covers its disc and everything nearer than `near_share`.
double reach_of(const Segment& chord) {
  return (0.5 + near_share) * geometry::length(chord.b - chord.a) * (1 + 1e-9);
}

} // namespace

BoundaryGuard::BoundaryGuard(const BoundarySites& sites, const geometry::Lattice& lattice) : chords_(chords_of(sites)) {
  TRIME_ASSERT(!sites.sites.empty());
  build_grid();
  classify_clear_cells(lattice);
}

/// Chooses the cells, then lists the discs by counting, summing and filling.
void BoundaryGuard::build_grid() {
  geometry::Box box;
  double area_of_discs = 0;
  for (const Segment& chord : chords_.segments()) {
    const Vec2 middle = 0.5 * (chord.a + chord.b);
    const double reach = reach_of(chord);
    box.include(middle - Vec2{reach, reach});
    box.include(middle + Vec2{reach, reach});
    area_of_discs += 4 * reach * reach;
  }
  const double n = static_cast<double>(chords_.segments().size()), area = box.width() * box.height();
  const double cells = std::clamp(cells_per_chord * n, 4096.0, most_cells);
  side_ = std::sqrt(std::fmax(area / cells, area_of_discs / most_entries));
  side_ = std::fmax(side_, std::fmax(box.width(), box.height()) * 0x1p-14);
  inverse_side_ = 1 / side_;
  corner_ = box.min - Vec2{side_, side_};
  columns_ = static_cast<int>(box.width() * inverse_side_) + 3;
  rows_ = static_cast<int>(box.height() * inverse_side_) + 3;
  const std::size_t count = static_cast<std::size_t>(columns_) * rows_;
  cell_start_.assign(count + 1, 0);
  const auto chords = static_cast<LocalIndex>(chords_.segments().size());
  for (LocalIndex k = 0; k < chords; ++k)
    for_each_cell_of(k, [&](std::size_t cell) { ++cell_start_[cell + 1]; });
  for (std::size_t cell = 0; cell < count; ++cell)
    cell_start_[cell + 1] += cell_start_[cell];
  cell_chord_.resize(cell_start_.back());
  std::vector<LocalIndex> place(cell_start_.begin(), cell_start_.end() - 1);
  for (LocalIndex k = 0; k < chords; ++k)
    for_each_cell_of(k, [&](std::size_t cell) { cell_chord_[place[cell]++] = k; });
}

/// Calls visit(cell) for the cells that the disc of a chord, a little enlarged, may meet.
template <class Visit>
void BoundaryGuard::for_each_cell_of(LocalIndex chord, const Visit& visit) const {
  const Segment& s = chords_.segments()[chord];
  const Vec2 middle = 0.5 * (s.a + s.b) - corner_;
  const double reach = reach_of(s) + 1e-9 * side_;
  const auto index = [this](double v, int n) { return std::clamp(static_cast<int>(v * inverse_side_), 0, n - 1); };
  const int i0 = index(middle.x - reach, columns_), i1 = index(middle.x + reach, columns_);
  const int j0 = index(middle.y - reach, rows_), j1 = index(middle.y + reach, rows_);
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i) {
      const double dx = std::fmax(0.0, std::fmax(i * side_ - middle.x, middle.x - (i + 1) * side_));
      const double dy = std::fmax(0.0, std::fmax(j * side_ - middle.y, middle.y - (j + 1) * side_));
      if (dx * dx + dy * dy <= reach * reach)
        visit(static_cast<std::size_t>(j) * columns_ + i);
    }
}

/// A cell without disc meets no chord, so one point decides for all of it, and for its clear right neighbours.
void BoundaryGuard::classify_clear_cells(const geometry::Lattice& lattice) {
  state_.assign(static_cast<std::size_t>(columns_) * rows_, Cell::near);
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i) {
      const std::size_t cell = static_cast<std::size_t>(j) * columns_ + i;
      if (cell_start_[cell + 1] > cell_start_[cell])
        continue;
      if (i > 0 && state_[cell - 1] != Cell::near) {
        state_[cell] = state_[cell - 1];
        continue;
      }
      const Vec2 center = lattice.snap(corner_ + Vec2{(i + 0.5) * side_, (j + 0.5) * side_});
      state_[cell] = chords_.inside(center) ? Cell::inside : Cell::outside;
    }
}

std::int64_t BoundaryGuard::cell_at(Vec2 p) const {
  const double x = (p.x - corner_.x) * inverse_side_, y = (p.y - corner_.y) * inverse_side_;
  if (!(x >= 0 && y >= 0 && x < columns_ && y < rows_))
    return -1;
  return static_cast<std::int64_t>(y) * columns_ + static_cast<std::int64_t>(x);
}

BoundaryGuard::Cell BoundaryGuard::state_at(Vec2 p) const {
  const std::int64_t cell = cell_at(p);
  return cell < 0 ? Cell::outside : state_[cell];
}

std::span<const LocalIndex> BoundaryGuard::chords_at(std::int64_t cell) const {
  if (cell < 0)
    return {};
  return std::span(cell_chord_).subspan(cell_start_[cell], cell_start_[cell + 1] - cell_start_[cell]);
}

bool BoundaryGuard::inside(Vec2 p) const {
  const Cell state = state_at(p);
  return state == Cell::near ? chords_.inside(p) : state == Cell::inside;
}

double BoundaryGuard::distance(Vec2 p, double reach) const {
  const auto found = chords_.nearest(p, reach);
  return found ? std::sqrt(found->squared_distance) : reach;
}

std::optional<Vec2> BoundaryGuard::correct(Vec2 p, double h, const geometry::Lattice& lattice) const {
  const Cell state = state_at(p);
  if (state == Cell::inside)
    return std::nullopt;
  const bool p_inside = state == Cell::near && chords_.inside(p);
  LocalIndex chord = p_inside ? deepest_disc(p) : -1;
  if (p_inside && chord < 0)
    return std::nullopt;
  if (!p_inside) {
    const auto near = chords_.nearest(p, 2 * h);
    chord = near ? near->segment : chords_.nearest(p).segment;
  }
  const Segment& s = chords_.segments()[chord];
  const Vec2 along = s.b - s.a, middle = 0.5 * (s.a + s.b), toward = p - middle;
  const double chord_length = geometry::length(along), distance = geometry::length(toward);
  if (p_inside && distance > 0 && geometry::cross(along, toward) >= 0.5 * chord_length * distance) {
    const Vec2 pushed = lattice.snap(middle + (push_share * chord_length / distance) * toward);
    if (inside(pushed) && deepest_disc(pushed) < 0)
      return pushed;
  }
  return lattice.snap(middle + push_share * geometry::left_normal(along));
}

LocalIndex BoundaryGuard::deepest_disc(Vec2 p) const {
  LocalIndex deepest = -1;
  double smallest = 0; // (distance from the middle / radius)^2
  for (const LocalIndex k : chords_at(cell_at(p))) {
    const Segment& chord = chords_.segments()[k];
    if (geometry::diametral_side(chord.a, chord.b, p) > 0)
      continue;
    const double ratio =
        4 * geometry::squared_length(p - 0.5 * (chord.a + chord.b)) / geometry::squared_length(chord.b - chord.a);
    if (deepest < 0 || ratio < smallest) {
      deepest = k;
      smallest = ratio;
    }
  }
  return deepest;
}

bool BoundaryGuard::encroaches(Vec2 p) const {
  const std::int64_t cell = cell_at(p);
  const Cell state = cell < 0 ? Cell::outside : state_[cell];
  if (state != Cell::near)
    return state == Cell::outside;
  for (const LocalIndex k : chords_at(cell)) {
    const Segment& chord = chords_.segments()[k];
    if (geometry::diametral_side(chord.a, chord.b, p) < 0)
      return true;
    const double limit = near_share * near_share * geometry::squared_length(chord.b - chord.a);
    if (geometry::squared_distance(p, chord) < limit)
      return true;
  }
  return !chords_.inside(p);
}

std::size_t BoundaryGuard::memory_bytes() const {
  return chords_.memory_bytes() + state_.capacity() * sizeof(Cell) +
         (cell_start_.capacity() + cell_chord_.capacity()) * sizeof(LocalIndex);
}

} // namespace trime::meshing
