// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/boundary_guard.hpp"

#include "chord_closure.hpp"
#include "trime/core/error.hpp"
#include "trime/geometry/diametral.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::meshing {

using geometry::Segment;
using geometry::Vec2;

namespace {

constexpr double near_share = 0.05; // of the chord length: closer sites encroach
constexpr double push_share = 0.6;  // of the chord length, from its middle
constexpr double cells_per_chord = 64;
constexpr double most_cells = 0x1p22;
constexpr double entries = 0x1p22, entries_per_chord = 64, most_entries = 0x1p25; // of all cell lists together

std::vector<Segment> chords_of(const BoundarySites& sites) {
  std::vector<Segment> chords;
  chords.reserve(sites.sites.size());
  for (std::size_t k = 0; k < sites.sites.size(); ++k) {
    const Segment chord = sites.chord(static_cast<LocalIndex>(k));
    const Vec2 middle = 0.5 * (chord.a + chord.b), shift = sites.periods.wrap(middle) - middle;
    chords.push_back({chord.a + shift, chord.b + shift});
  }
  return chords;
}

/// Calls visit(shift) for the shifts by up to so many periods that `reach` asks for, none excluded.
template <class Visit>
void for_each_shift(const geometry::Periods& periods, double reach, const Visit& visit) {
  const auto images = [reach](double period) { return period > 0 ? 1 + static_cast<int>(reach / period) : 0; };
  for (int i = -images(periods.x); i <= images(periods.x); ++i)
    for (int j = -images(periods.y); j <= images(periods.y); ++j)
      visit(Vec2{i * periods.x, j * periods.y});
}

/// Radius around the middle of the chord that covers its disc and everything nearer than `near_share`.
double reach_of(const Segment& chord) {
  return (0.5 + near_share) * geometry::length(chord.b - chord.a) * (1 + 1e-9);
}

} // namespace

BoundaryGuard::BoundaryGuard(const BoundarySites& sites, const geometry::Lattice& lattice)
    : periods_(sites.periods), chords_(chords_of(sites)) {
  TRIME_ASSERT(!is_empty() || periods_.any());
  if (is_empty())
    return;
  const geometry::Box window = choose_cells();
  if (periods_.any()) {
    add_images(window);
    close_chords(window, lattice);
  }
  list_discs();
  classify_clear_cells(lattice);
}

/// Chooses the cells: around all discs, or one period long. Returns the box that holds all cells; it has no end along
/// axes that are not periodic.
geometry::Box BoundaryGuard::choose_cells() {
  geometry::Box box;
  double area_of_discs = 0;
  for (const Segment& chord : chords_.segments()) {
    const Vec2 middle = 0.5 * (chord.a + chord.b);
    const double reach = reach_of(chord);
    box.include(middle - Vec2{reach, reach});
    box.include(middle + Vec2{reach, reach});
    area_of_discs += 4 * reach * reach;
  }
  if (periods_.x > 0) {
    box.min.x = periods_.min.x;
    box.max.x = periods_.min.x + periods_.x;
  }
  if (periods_.y > 0) {
    box.min.y = periods_.min.y;
    box.max.y = periods_.min.y + periods_.y;
  }
  const double n = static_cast<double>(chords_.segments().size()), area = box.width() * box.height();
  const double cells = std::clamp(cells_per_chord * n, 4096.0, most_cells);
  const double affordable = std::clamp(entries_per_chord * n, entries, most_entries);
  side_ = std::sqrt(std::fmax(area / cells, area_of_discs / affordable));
  side_ = std::fmax(side_, std::fmax(box.width(), box.height()) * 0x1p-14);
  inverse_side_ = 1 / side_;
  corner_ = box.min - Vec2{side_, side_};
  columns_ = static_cast<int>(box.width() * inverse_side_) + 3;
  rows_ = static_cast<int>(box.height() * inverse_side_) + 3;
  const double margin = 4 * side_, far = std::numeric_limits<double>::infinity();
  return {{periods_.x > 0 ? box.min.x - margin : -far, periods_.y > 0 ? box.min.y - margin : -far},
          {periods_.x > 0 ? box.max.x + margin : far, periods_.y > 0 ? box.max.y + margin : far}};
}

/// The images whose discs meet the window, and with them all that meet it themselves.
void BoundaryGuard::add_images(const geometry::Box& window) {
  for (const Segment& chord : chords_.segments()) {
    const Vec2 middle = 0.5 * (chord.a + chord.b);
    const double reach = reach_of(chord);
    for_each_shift(periods_, reach + 4 * side_, [&](Vec2 shift) {
      const Vec2 low = middle + shift - Vec2{reach, reach}, high = middle + shift + Vec2{reach, reach};
      if (shift != Vec2{} && low.x <= window.max.x && high.x >= window.min.x && low.y <= window.max.y &&
          high.y >= window.min.y)
        images_.push_back({chord.a + shift, chord.b + shift});
    });
  }
}

void BoundaryGuard::close_chords(const geometry::Box& window, const geometry::Lattice& lattice) {
  std::vector<Segment> all(chords_.segments().begin(), chords_.segments().end());
  all.insert(all.end(), images_.begin(), images_.end());
  closed_ = geometry::SegmentGrid(close_outside(std::move(all), window, std::fmax(periods_.x, periods_.y)));
  // No other chord leads through the disc of the first: what lies in it on the left is inside.
  const Segment& first = chords_.segments()[0];
  const Vec2 middle = 0.5 * (first.a + first.b);
  inverted_ = !closed_.inside(periods_.wrap(lattice.snap(middle + 0.25 * geometry::left_normal(first.b - first.a))));
}

/// Lists the discs of each cell by counting, summing and filling.
void BoundaryGuard::list_discs() {
  const std::size_t count = static_cast<std::size_t>(columns_) * rows_;
  cell_start_.assign(count + 1, 0);
  for (LocalIndex k = 0; k < disc_count(); ++k)
    for_each_cell_of(disc(k), [&](std::size_t cell) { ++cell_start_[cell + 1]; });
  for (std::size_t cell = 0; cell < count; ++cell)
    cell_start_[cell + 1] += cell_start_[cell];
  cell_chord_.resize(cell_start_.back());
  std::vector<LocalIndex> place(cell_start_.begin(), cell_start_.end() - 1);
  for (LocalIndex k = 0; k < disc_count(); ++k)
    for_each_cell_of(disc(k), [&](std::size_t cell) { cell_chord_[place[cell]++] = k; });
}

/// Calls visit(cell) for the cells that the disc of a chord, a little enlarged, may meet.
template <class Visit>
void BoundaryGuard::for_each_cell_of(const Segment& s, const Visit& visit) const {
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
      state_[cell] = inside_polygon(center) ? Cell::inside : Cell::outside;
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
  return cell >= 0 ? state_[cell] : is_empty() ? Cell::inside : Cell::outside;
}

std::span<const LocalIndex> BoundaryGuard::chords_at(std::int64_t cell) const {
  if (cell < 0)
    return {};
  return std::span(cell_chord_).subspan(cell_start_[cell], cell_start_[cell + 1] - cell_start_[cell]);
}

bool BoundaryGuard::inside_polygon(Vec2 p) const {
  return periods_.any() ? closed_.inside(p) != inverted_ : chords_.inside(p);
}

bool BoundaryGuard::inside(Vec2 p) const {
  p = periods_.wrap(p);
  const Cell state = state_at(p);
  return state == Cell::near ? inside_polygon(p) : state == Cell::inside;
}

/// Middles of chords are canonical: of a point that is, one image to each side is enough.
std::optional<BoundaryGuard::NearChord> BoundaryGuard::nearest(Vec2 p, double reach) const {
  std::optional<NearChord> best;
  const auto look_from = [&](Vec2 shift) {
    const auto found = chords_.nearest(p + shift, best ? std::sqrt(best->squared_distance) : reach);
    if (!found || (best && found->squared_distance >= best->squared_distance))
      return;
    const Segment& chord = chords_.segments()[found->segment];
    best = {{chord.a - shift, chord.b - shift}, found->squared_distance};
  };
  look_from({});
  if (periods_.any())
    for_each_shift(periods_, 0, [&](Vec2 shift) {
      if (shift != Vec2{})
        look_from(shift);
    });
  return best;
}

double BoundaryGuard::distance(Vec2 p, double reach) const {
  const auto found = nearest(periods_.wrap(p), reach);
  return found ? std::sqrt(found->squared_distance) : reach;
}

BoundaryGuard::CellView BoundaryGuard::cells() const {
  static_assert(sizeof(Cell) == 1);
  return {is_empty() ? nullptr : reinterpret_cast<const std::uint8_t*>(state_.data()),
          static_cast<std::uint8_t>(Cell::inside),
          corner_,
          inverse_side_,
          columns_,
          rows_};
}

bool BoundaryGuard::may_meet_chord(const geometry::Box& box) const {
  bool found = false;
  for_each_shift(periods_, 0, [&](Vec2 shift) {
    if (!found)
      chords_.for_each_near({box.min + shift, box.max + shift}, [&](LocalIndex) {
        found = true;
        return false;
      });
  });
  return found;
}

std::optional<Vec2> BoundaryGuard::correct(Vec2 image, double h, const geometry::Lattice& lattice) const {
  const Vec2 p = periods_.wrap(image), shift = image - p;
  const Cell state = state_at(p);
  if (state == Cell::inside)
    return std::nullopt;
  const bool p_inside = state == Cell::near && inside_polygon(p);
  const LocalIndex deepest = p_inside ? deepest_disc(p) : -1;
  if (p_inside && deepest < 0)
    return std::nullopt;
  Segment s;
  if (p_inside) {
    s = disc(deepest);
  } else {
    const auto near = nearest(p, 2 * h);
    s = near ? near->chord : nearest(p, std::numeric_limits<double>::infinity())->chord;
  }
  const Vec2 along = s.b - s.a, middle = 0.5 * (s.a + s.b), toward = p - middle;
  const double chord_length = geometry::length(along), distance = geometry::length(toward);
  if (p_inside && distance > 0 && geometry::cross(along, toward) >= 0.5 * chord_length * distance) {
    const Vec2 pushed = lattice.snap(middle + (push_share * chord_length / distance) * toward);
    if (inside(pushed) && deepest_disc(periods_.wrap(pushed)) < 0)
      return pushed + shift;
  }
  return lattice.snap(middle + push_share * geometry::left_normal(along)) + shift;
}

LocalIndex BoundaryGuard::deepest_disc(Vec2 p) const {
  LocalIndex deepest = -1;
  double smallest = 0; // (distance from the middle / radius)^2
  for (const LocalIndex k : chords_at(cell_at(p))) {
    const Segment& chord = disc(k);
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
  p = periods_.wrap(p);
  const std::int64_t cell = cell_at(p);
  const Cell state = state_at(p);
  if (state != Cell::near)
    return state == Cell::outside;
  for (const LocalIndex k : chords_at(cell)) {
    const Segment& chord = disc(k);
    if (geometry::diametral_side(chord.a, chord.b, p) < 0)
      return true;
    const double limit = near_share * near_share * geometry::squared_length(chord.b - chord.a);
    if (geometry::squared_distance(p, chord) < limit)
      return true;
  }
  return !inside_polygon(p);
}

std::size_t BoundaryGuard::memory_bytes() const {
  return chords_.memory_bytes() + closed_.memory_bytes() + images_.capacity() * sizeof(Segment) +
         state_.capacity() * sizeof(Cell) + (cell_start_.capacity() + cell_chord_.capacity()) * sizeof(LocalIndex);
}

} // namespace trime::meshing
