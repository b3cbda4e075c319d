// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/boundary_guard.hpp"

#include "core/thread_loop.hpp"
#include "geometry/periodic_outline.hpp"
#include "geometry/predicates.hpp"
#include "polygon/disc_cells.hpp"
#include "polygon/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace trime::polygon {

using geometry::Segment;
using geometry::Vec2;

namespace {

// [cells] Of the guard's grid for each chord: most places then answer by one look-up.
constexpr double cells_per_chord = 64;

// [cells] Of the guard's grid, at least, where chords are few: a few KiB.
constexpr double least_guard_cells = 4096;

// [cells] Of the guard's grid, at most: 4 MiB.
constexpr double most_guard_cells = 0x1p22;

// [longer side of the grid] No side of a cell is shorter: bounds rows and columns of grids far from square.
constexpr double least_cell_side = 0x1p-14;

// [entries] Of all lists of discs together, always allowed: 16 MiB. Cells grow if there would be more.
constexpr double entries = 0x1p22;

// [entries] Number of entries in these lists for each chord: one for each of its cells.
constexpr double entries_per_chord = 64;

// [entries] Of these lists, at most: 128 MiB.
constexpr double most_entries = 0x1p25;

/// The image whose middle lies in the container.
Segment canonical(const Segment& chord, const geometry::Periods& periods) {
  const Vec2 middle = 0.5 * (chord.a + chord.b), shift = periods.wrap(middle) - middle;
  return {chord.a + shift, chord.b + shift};
}

std::vector<Segment> chords_of(const BoundarySites& sites) {
  std::vector<Segment> chords;
  chords.reserve(sites.sites.size());
  for (std::size_t k = 0; k < sites.sites.size(); ++k)
    chords.push_back(canonical(sites.chord(static_cast<LocalIndex>(k)), sites.periods));
  return chords;
}

/// Calls visit(shift) for all shifts by as many periods as `reach` asks for.
template <class Visit>
void for_each_shift(const geometry::Periods& periods, double reach, const Visit& visit) {
  const auto images = [reach](double period) { return period > 0 ? 1 + static_cast<int>(reach / period) : 0; };
  for (int i = -images(periods.x); i <= images(periods.x); ++i)
    for (int j = -images(periods.y); j <= images(periods.y); ++j)
      visit(Vec2{i * periods.x, j * periods.y});
}

/// Chessboard distances along one row of cells: loops over bytes that know no order, so that compilers make vectors of
/// them.
class RowClearance {
public:
  /// @param border_is_near a disc may lie right beyond both ends
  RowClearance(std::size_t width, bool border_is_near)
      : width_(width), from_(width + 2 * margin, border_is_near ? std::uint8_t{0} : farthest), to_(from_) {}

  /// Where the row is to be filled in: 0 for a cell with a disc, else `farthest`.
  std::span<std::uint8_t> start() { return {&from_[margin], width_}; }
  /// The distances of that row. Shifts by 1, 2, 4 ... cells together reach all cells up to the farthest.
  void finish(std::uint8_t* row) {
    for (std::size_t step = 1; step <= farthest; step *= 2) {
      for (std::size_t i = margin; i < margin + width_; ++i)
        to_[i] = std::min(from_[i], further(std::min(from_[i - step], from_[i + step]), step));
      std::swap(from_, to_);
    }
    std::copy_n(&from_[margin], width_, row);
  }

  static constexpr std::uint8_t farthest = PolygonRules::farthest_cell;

private:
  static std::uint8_t further(std::uint8_t v, std::size_t step) { return static_cast<std::uint8_t>(v + step); }
  static constexpr std::size_t margin = farthest;
  std::size_t width_;
  std::vector<std::uint8_t> from_, to_; // with a margin at both ends
};

/// One step from a neighbouring row to this one, straight or aslant. @pre width >= 2
void lower_by_row(std::uint8_t* row, const std::uint8_t* other, std::size_t width) {
  const auto lower = [row](std::size_t i, std::uint8_t v) {
    row[i] = std::min(row[i], static_cast<std::uint8_t>(v + 1));
  };
  lower(0, std::min(other[0], other[1]));
  for (std::size_t i = 1; i + 1 < width; ++i)
    lower(i, std::min(std::min(other[i - 1], other[i]), other[i + 1]));
  lower(width - 1, std::min(other[width - 2], other[width - 1]));
}

} // namespace

BoundaryGuard::BoundaryGuard(const BoundarySites& sites, const geometry::Lattice& lattice)
    : periods_(sites.periods), chords_(chords_of(sites)) {
  TRIME_ASSERT(has_rim() || periods_.any());
  std::vector<Segment> inner;
  for (const InnerChord& chord : sites.inner.chords)
    inner.push_back(periods_.any() ? canonical(chord.ends, periods_) : chord.ends);
  if (!inner.empty())
    inner_ = geometry::SegmentGrid(std::move(inner));
  if (is_empty())
    return;
  const geometry::Box window = choose_cells();
  if (periods_.any()) {
    add_images(chords_, window);
    if (has_rim())
      close_chords(window, lattice);
  }
  first_inner_ = static_cast<LocalIndex>(images_.size());
  images_.insert(images_.end(), inner_.segments().begin(), inner_.segments().end());
  if (periods_.any())
    add_images(inner_, window);
  cells_.list_discs(chords_.segments(), images_);
  classify_cells(lattice);
}

/// Chooses the cells: around all discs, or one period long. Returns the box that holds all cells; it has no end along
/// axes that are not periodic.
geometry::Box BoundaryGuard::choose_cells() {
  geometry::Box box;
  double area_of_discs = 0;
  const auto include = [&](std::span<const Segment> chords) {
    for (const Segment& chord : chords) {
      const Vec2 middle = 0.5 * (chord.a + chord.b);
      const double reach = reach_of(chord);
      box.include(middle - Vec2{reach, reach});
      box.include(middle + Vec2{reach, reach});
      area_of_discs += 4 * reach * reach;
    }
  };
  include(chords_.segments());
  include(inner_.segments());
  if (periods_.x > 0) {
    box.min.x = periods_.min.x;
    box.max.x = periods_.min.x + periods_.x;
  }
  if (periods_.y > 0) {
    box.min.y = periods_.min.y;
    box.max.y = periods_.min.y + periods_.y;
  }
  const double n = static_cast<double>(chords_.segments().size() + inner_.segments().size()),
               area = box.width() * box.height();
  const double cells = std::clamp(cells_per_chord * n, least_guard_cells, most_guard_cells);
  const double affordable = std::clamp(entries_per_chord * n, entries, most_entries);
  double side = std::sqrt(std::fmax(area / cells, area_of_discs / affordable));
  side = std::fmax(side, std::fmax(box.width(), box.height()) * least_cell_side);
  cells_ = DiscCells(box, side);
  const double margin = 4 * side, far = std::numeric_limits<double>::infinity();
  return {{periods_.x > 0 ? box.min.x - margin : -far, periods_.y > 0 ? box.min.y - margin : -far},
          {periods_.x > 0 ? box.max.x + margin : far, periods_.y > 0 ? box.max.y + margin : far}};
}

/// The images whose discs meet the window, and with them all that meet it themselves.
void BoundaryGuard::add_images(const geometry::SegmentGrid& chords, const geometry::Box& window) {
  for (const Segment& chord : chords.segments()) {
    const Vec2 middle = 0.5 * (chord.a + chord.b);
    const double reach = reach_of(chord);
    for_each_shift(periods_, reach + 4 * cells_.side(), [&](Vec2 shift) {
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
  closed_ = geometry::SegmentGrid(geometry::close_outside(std::move(all), window, std::fmax(periods_.x, periods_.y)));
  // No other chord leads through the disc of the first: what lies in it on the left is inside.
  const Segment& first = chords_.segments()[0];
  const Vec2 middle = 0.5 * (first.a + first.b);
  inverted_ = !closed_.inside(periods_.wrap(lattice.snap(middle + 0.25 * geometry::left_normal(first.b - first.a))));
}

/// Strips of rows at the same time, each with as many rows around it as the clearance can reach: few strips, since
/// those rows are measured for each of them. No state depends on the strips.
void BoundaryGuard::classify_cells(const geometry::Lattice& lattice) {
  state_.assign(cells_.count(), near_disc);
  const int rows = cells_.rows(), columns = cells_.columns();
  const int height = std::max(strip_rows, (rows - 1) / thread_count() + 1);
  thread_loop((rows - 1) / height + 1, 1, [&](std::ptrdiff_t strip, int) {
    const int first = static_cast<int>(strip) * height, last = std::min(rows, first + height);
    const int low = std::max(0, first - PolygonRules::farthest_cell),
              high = std::min(rows, last + PolygonRules::farthest_cell);
    std::vector<std::uint8_t> clearance = clearance_of(low, high);
    for (int j = first; j < last; ++j)
      classify_row(j, &clearance[static_cast<std::size_t>(j - low) * columns], lattice);
  });
}

/// @brief Chessboard distance of each cell of rows [low, high) to the nearest of them with a disc: along the rows, then
/// down and up from row to row (Rosenfeld and Pfaltz 1966). What lies beyond the border of a periodic axis is not
/// known, and may be a disc.
std::vector<std::uint8_t> BoundaryGuard::clearance_of(int low, int high) const {
  const std::size_t width = static_cast<std::size_t>(cells_.columns()), rows = static_cast<std::size_t>(high - low);
  std::vector<std::uint8_t> clearance(width * rows);
  RowClearance along(width, periods_.x > 0);
  for (std::size_t j = 0; j < rows; ++j) {
    cells_.mark_discs(low + static_cast<int>(j), RowClearance::farthest, along.start());
    along.finish(&clearance[j * width]);
  }
  const auto border = [&](std::size_t j) {
    for (std::size_t i = 0; i < width && periods_.y > 0; ++i)
      clearance[j * width + i] = std::min(clearance[j * width + i], std::uint8_t{1});
  };
  if (low == 0)
    border(0);
  if (high == cells_.rows())
    border(rows - 1);
  for (std::size_t j = 1; j < rows; ++j)
    lower_by_row(&clearance[j * width], &clearance[(j - 1) * width], width);
  for (std::size_t j = rows - 1; j-- > 0;)
    lower_by_row(&clearance[j * width], &clearance[(j + 1) * width], width);
  return clearance;
}

/// A cell without disc meets no chord, so one point decides for all of it, and for its clear right neighbours.
void BoundaryGuard::classify_row(int j, const std::uint8_t* clearance, const geometry::Lattice& lattice) {
  const auto columns = static_cast<std::size_t>(cells_.columns());
  std::int8_t* states = &state_[static_cast<std::size_t>(j) * columns];
  for (std::size_t i = 0; i < columns; ++i) {
    if (clearance[i] == 0)
      continue;
    const void* disc = std::memchr(clearance + i, 0, columns - i);
    const std::size_t end =
        disc != nullptr ? static_cast<std::size_t>(static_cast<const std::uint8_t*>(disc) - clearance) : columns;
    const bool inside = inside_polygon(lattice.snap(cells_.middle(static_cast<int>(i), j)));
    for (; i < end; ++i)
      states[i] = static_cast<std::int8_t>(inside ? clearance[i] : -clearance[i]);
  }
}

int BoundaryGuard::state_at(Vec2 p) const {
  const std::int64_t cell = cells_.cell_at(p);
  return cell >= 0 ? state_[static_cast<std::size_t>(cell)] : is_empty() ? 1 : -1;
}

bool BoundaryGuard::inside_polygon(Vec2 p) const {
  return periods_.any() ? !has_rim() || closed_.inside(p) != inverted_ : chords_.inside(p);
}

bool BoundaryGuard::inside(Vec2 p) const {
  p = periods_.wrap(p);
  const int state = state_at(p);
  return state == near_disc ? inside_polygon(p) : state > 0;
}

/// Middles of chords are canonical: of a point that is, one image to each side is enough.
std::optional<BoundaryGuard::NearChord> BoundaryGuard::nearest(const geometry::SegmentGrid& chords, Vec2 p,
                                                               double reach) const {
  std::optional<NearChord> best;
  if (chords.segments().empty())
    return best;
  const auto look_from = [&](Vec2 shift) {
    const auto found = chords.nearest(p + shift, best ? std::sqrt(best->squared_distance) : reach);
    if (!found || (best && found->squared_distance >= best->squared_distance))
      return;
    const Segment& chord = chords.segments()[found->segment];
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
  p = periods_.wrap(p);
  if (clear_way(p) >= reach)
    return reach;
  const auto found = nearest(chords_, p, reach);
  const double way = found ? std::sqrt(found->squared_distance) : reach;
  const auto inner = nearest(inner_, p, way);
  return inner ? std::fmin(way, std::sqrt(inner->squared_distance)) : way;
}

GuardCells BoundaryGuard::cells() const {
  return {is_empty() ? nullptr : state_.data(), cells_.corner(), cells_.inverse_side(), cells_.columns(),
          cells_.rows()};
}

/// From a cell n cells away from all discs it is at least n - 1 of their sides to any chord.
double BoundaryGuard::clear_way(Vec2 p) const {
  constexpr double rounding = 1 - 1e-6; // far above the error of the place in the grid
  return (std::abs(state_at(p)) - 1) * (cells_.side() * rounding);
}

std::optional<Vec2> BoundaryGuard::correct(Vec2 image, double h, const geometry::Lattice& lattice) const {
  const Vec2 p = periods_.wrap(image), shift = image - p;
  const int state = state_at(p);
  if (state > 0)
    return std::nullopt;
  const bool p_inside = state == near_disc && inside_polygon(p);
  const LocalIndex deepest = p_inside ? deepest_disc(p) : -1;
  if (p_inside && deepest < 0)
    return std::nullopt;
  Segment s;
  if (p_inside) {
    s = disc(deepest);
  } else {
    const auto near = nearest(chords_, p, 2 * h);
    s = near ? near->chord : nearest(chords_, p, std::numeric_limits<double>::infinity())->chord;
  }
  if (p_inside && has_both_sides(deepest) && geometry::cross(s.b - s.a, p - s.a) < 0)
    std::swap(s.a, s.b);
  const Vec2 along = s.b - s.a, middle = 0.5 * (s.a + s.b), toward = p - middle;
  const double chord_length = geometry::length(along), distance = geometry::length(toward);
  if (p_inside && distance > 0 && geometry::cross(along, toward) >= 0.5 * chord_length * distance) {
    const Vec2 pushed = lattice.snap(middle + (PolygonRules::push_way * chord_length / distance) * toward);
    if (inside(pushed) && deepest_disc(periods_.wrap(pushed)) < 0)
      return pushed + shift;
  }
  return lattice.snap(middle + PolygonRules::push_way * geometry::left_normal(along)) + shift;
}

bool BoundaryGuard::pushes(Vec2 p) const {
  p = periods_.wrap(p);
  const int state = state_at(p);
  return state <= 0 && !(state == near_disc && inside_polygon(p) && deepest_disc(p) < 0);
}

LocalIndex BoundaryGuard::deepest_disc(Vec2 p) const {
  LocalIndex deepest = -1;
  double smallest = 0; // (distance from the middle / radius)^2
  for (const LocalIndex k : cells_.discs_at(cells_.cell_at(p))) {
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
  const std::int64_t cell = cells_.cell_at(p);
  const int state = state_at(p);
  if (state != near_disc)
    return state < 0;
  for (const LocalIndex k : cells_.discs_at(cell)) {
    const Segment& chord = disc(k);
    if (geometry::diametral_side(chord.a, chord.b, p) < 0)
      return true;
    const double limit =
        PolygonRules::near_chord * PolygonRules::near_chord * geometry::squared_length(chord.b - chord.a);
    if (geometry::squared_distance(p, chord) < limit)
      return true;
  }
  return !inside_polygon(p);
}

std::size_t BoundaryGuard::memory_bytes() const {
  return chords_.memory_bytes() + closed_.memory_bytes() + images_.capacity() * sizeof(Segment) + state_.capacity() +
         cells_.memory_bytes();
}

} // namespace trime::polygon
