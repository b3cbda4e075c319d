// SPDX-License-Identifier: BSD-3-Clause
#include "fields/read_field.hpp"

#include "comm/agree.hpp"
#include "core/angle.hpp"
#include "core/elementary.hpp"
#include "core/random.hpp"
#include "fields/nearest_fill.hpp"
#include "fields/outline.hpp"
#include "fields/smooth.hpp"
#include "trime/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace trime::fields {
namespace {

constexpr std::int64_t band_values = std::int64_t{1} << 22; // read and sent at once
constexpr std::int64_t margin = 2; // [cells] around the shape: simplified curves may leave it a little

geometry::Box cells_of(const Axis& x, const Axis& y) {
  return {{x.first - x.step / 2, y.first - y.step / 2}, {x.last() + x.step / 2, y.last() + y.step / 2}};
}

/// Returns how many columns make a period; 0 if the raster does not go around.
std::int64_t columns_around(const Axis& x, double period) {
  if (period <= 0)
    return 0;
  const double columns = std::rint(period / x.step);
  const bool closes = std::fabs(columns * x.step - period) < 1e-6 * period;
  return closes && static_cast<double>(x.count) >= columns ? static_cast<std::int64_t>(columns) : 0;
}

/// The part of a file that a shape needs, and the axes of the file in the period of the shape.
struct Cut {
  Axis x, y;
  Window window;
  std::int64_t around = 0; ///< columns in a period; 0: none
  geometry::Box cells;     ///< where the file has cells, in the period of the shape
};

/// Chooses the period of the file that covers most of the shape.
double best_shift(const Axis& x, const geometry::Box& box, double period) {
  double best = 0, most = -1;
  for (int k = -2; period > 0 && k <= 2; ++k) {
    const double shift = k * period;
    const double covered =
        std::fmin(box.max.x, x.last() + x.step / 2 + shift) - std::fmax(box.min.x, x.first - x.step / 2 + shift);
    if (k == -2 || covered > most) {
      most = covered;
      best = shift;
    }
  }
  return best;
}

/// The cosine of a latitude, at least that of 89 degrees.
double parallel_share(double latitude) {
  return elementary::cos(std::fmin(std::fabs(latitude), 89) * degrees);
}

/// The half widths of the weights of smoothed() for a cut of the file.
SmoothReach reach_of(const FieldRequest& request, const Axis& x, const Axis& y) {
  if (request.per_degree <= 0)
    return {[width = request.smooth / x.step](std::int64_t) { return width; }, request.smooth / y.step};
  const double angle = request.smooth / request.per_degree;
  return {[angle, x, y](std::int64_t row) { return angle / x.step / parallel_share(y.at(static_cast<double>(row))); },
          angle / y.step};
}

/// The box with room for the values around that are averaged. With a period it may be wider than one, at most twice as
/// wide: values on both sides of the opposite meridian are averages of all values around them.
geometry::Box with_reach(geometry::Box box, const FieldRequest& request) {
  const double up = request.per_degree > 0 ? request.smooth / request.per_degree : request.smooth;
  box.min.y -= up;
  box.max.y += up;
  const double latitude = std::fmax(std::fabs(box.min.y), std::fabs(box.max.y));
  double along = request.per_degree > 0 ? up / parallel_share(latitude) : up;
  if (request.period > 0)
    along = std::fmin(along, request.period / 2);
  box.min.x -= along;
  box.max.x += along;
  return box;
}

Cut cut_of(const RasterFile& file, const Outline& outline, const FieldRequest& request) {
  const double period = request.period;
  Cut cut{file.x(), file.y(), {}, columns_around(file.x(), period), {}};
  geometry::Box box = outline.box;
  cut.x.first += best_shift(cut.x, box, period);
  cut.cells = cells_of(cut.x, cut.y);
  if (outline.winds) {
    const double middle = (box.min.x + box.max.x) / 2, y = (box.min.y + box.max.y) / 2;
    box.min.x = middle - period / 2;
    box.max.x = middle + period / 2;
    (y > 0 ? box.max.y : box.min.y) = y > 0 ? cut.cells.max.y : cut.cells.min.y;
  }
  if (cut.around > 0) {
    cut.cells.min.x = box.min.x - period;
    cut.cells.max.x = box.max.x + period;
  }
  box = with_reach(box, request);
  const auto range = [](const Axis& axis, double low, double high, bool bounded) {
    auto first = static_cast<std::int64_t>(std::floor(std::clamp(axis.index(low), -1e9, 1e9))) - margin;
    auto last = static_cast<std::int64_t>(std::ceil(std::clamp(axis.index(high), -1e9, 1e9))) + margin;
    if (bounded) {
      first = std::clamp<std::int64_t>(first, 0, axis.count - 1);
      last = std::clamp<std::int64_t>(last, 0, axis.count - 1);
    }
    return std::pair(first, last - first + 1);
  };
  std::tie(cut.window.first_column, cut.window.columns) = range(cut.x, box.min.x, box.max.x, cut.around == 0);
  std::tie(cut.window.first_row, cut.window.rows) = range(cut.y, box.min.y, box.max.y, true);
  return cut;
}

/// Reads columns of a window that may go around the Earth.
void read_around(RasterFile& file, const Window& window, std::int64_t around, std::vector<double>& out) {
  out.resize(static_cast<std::size_t>(window.rows * window.columns));
  if (around == 0) {
    file.read(window, out.data());
    return;
  }
  std::vector<double> part;
  for (std::int64_t column = 0; column < window.columns;) {
    const std::int64_t in_file = ((window.first_column + column) % around + around) % around;
    const std::int64_t columns = std::min(window.columns - column, around - in_file);
    part.resize(static_cast<std::size_t>(window.rows * columns));
    file.read({in_file, columns, window.first_row, window.rows}, part.data());
    for (std::int64_t row = 0; row < window.rows; ++row)
      std::copy_n(part.begin() + row * columns, columns, out.begin() + row * window.columns + column);
    column += columns;
  }
}

/// The sides of a cell in the unit of `smooth`, along rows in the mean, since few rows are near a pole.
geometry::Vec2 cell_of(const FieldRequest& request, const Axis& x, const Axis& y) {
  if (request.smooth <= 0)
    return {};
  const SmoothReach reach = reach_of(request, x, y);
  double in_row = 0;
  for (std::int64_t row = 0; row < y.count; ++row)
    in_row += reach.in_row(row) / static_cast<double>(y.count);
  return {request.smooth / in_row, request.smooth / reach.in_column};
}

/// Advice such as "make a coarser raster: gdal_translate -outsize 25% 25%". @param share of the rows and columns
std::string coarser_raster(double share) {
  const double percent = std::floor(100 * share);
  return percent >= 1 ? fmt::format("make a coarser raster: gdal_translate -outsize {0:g}% {0:g}%", percent)
                      : "make a much coarser raster with gdal_translate -outsize";
}

/// @throws GeometryError if the values would be averaged over too many cells
void check_smooth(const Cut& cut, const FieldRequest& request) {
  const auto row_at = [&](std::int64_t row) { return cut.y.at(static_cast<double>(row)); };
  const Axis rows{row_at(cut.window.first_row), cut.y.step, cut.window.rows};
  if (request.smooth <= 0)
    return;
  const geometry::Vec2 cell = cell_of(request, cut.x, rows);
  const double widest = request.smooth / std::fmin(cell.x, cell.y);
  if (widest > most_smooth_cells)
    throw GeometryError(fmt::format("{}: expected a length 'smooth' of at most {:g} cells of the raster, found {:g}, "
                                    "which are {:.4g} cells; it has the unit of the mesh. Take a smaller length, or {}",
                                    request.path, most_smooth_cells, request.smooth, widest,
                                    coarser_raster(most_smooth_cells / widest)));
}

Raster read_cut(RasterFile& file, const Cut& cut, const FieldRequest& request) {
  const auto values = static_cast<double>(cut.window.columns) * static_cast<double>(cut.window.rows);
  if (values > most_values)
    throw GeometryError(fmt::format(
        "{}: expected at most {:.0e} values around the shape, since each rank holds all of "
        "them, found {} x {}; {}{}",
        request.path, most_values, cut.window.columns, cut.window.rows, coarser_raster(std::sqrt(most_values / values)),
        request.smooth > 0 ? ", or take a smaller 'smooth', which adds values around" : ""));
  Raster raster{{cut.x.at(static_cast<double>(cut.window.first_column)), cut.x.step, cut.window.columns},
                {cut.y.at(static_cast<double>(cut.window.first_row)), cut.y.step, cut.window.rows}};
  const bool fits =
      file.fits_single() && (request.fill != Fill::value ||
                             static_cast<double>(static_cast<float>(request.fill_value)) == request.fill_value);
  fits ? raster.singles.reserve(raster.size()) : raster.doubles.reserve(raster.size());
  const std::int64_t rows_at_once = std::max<std::int64_t>(1, band_values / cut.window.columns);
  std::vector<double> band;
  for (std::int64_t row = 0; row < cut.window.rows; row += rows_at_once) {
    Window part = cut.window;
    part.first_row += row;
    part.rows = std::min(rows_at_once, cut.window.rows - row);
    read_around(file, part, cut.around, band);
    if (request.fill == Fill::value)
      std::replace_if(
          band.begin(), band.end(), [](double value) { return std::isnan(value); }, request.fill_value);
    if (fits)
      std::transform(band.begin(), band.end(), std::back_inserter(raster.singles),
                     [](double value) { return static_cast<float>(value); });
    else
      raster.doubles.insert(raster.doubles.end(), band.begin(), band.end());
  }
  return raster;
}

/// @throws GeometryError with row, column, place and number of the values that the shape needs and the file lacks
void check_values(const Outline& outline, const Raster& raster, const Cut& cut, const RasterFile& file,
                  const std::string& path) {
  const MissingValues missing = missing_values(outline, raster);
  if (missing.count == 0)
    return;
  const std::int64_t row = cut.window.first_row + missing.row, column = cut.window.first_column + missing.column;
  const std::int64_t columns = cut.around > 0 ? cut.around : file.x().count;
  throw GeometryError(fmt::format(
      "{}: expected data everywhere in the shape, found no data in {} of the cells that it needs, the first one in row "
      "{}, column {}, at ({:.9g}, {:.9g}). Set 'fill = nearest' to take the nearest value, or 'fill = VALUE'",
      path, missing.count, file.begins_in_north() ? file.y().count - row : row + 1,
      (column % columns + columns) % columns + 1, raster.x.at(static_cast<double>(missing.column)),
      raster.y.at(static_cast<double>(missing.row))));
}

/// A hash of places and values.
std::uint64_t hash_of(const Raster& raster) {
  std::uint64_t hash = 0;
  const auto add = [&](double value) { hash = mix_bits(hash ^ std::bit_cast<std::uint64_t>(value)); };
  for (const Axis* axis : {&raster.x, &raster.y}) {
    add(axis->first);
    add(axis->step);
    add(static_cast<double>(axis->count));
  }
  for (std::size_t k = 0; k < raster.size(); ++k)
    add(raster.value(k));
  return hash;
}

/// Holds what rank 0 knows, apart from the values.
struct Head {
  Axis x, y;
  bool single = false, has_filled = false;
  double middle = 0;
  std::uint64_t hash = 0;
};

/// Rank 0 alone: reads, checks and fills.
Raster read_on_root(const FieldRequest& request, const geometry::Boundary& boundary, const ToFile& to_file,
                    Head& head) {
  const std::unique_ptr<RasterFile> file = open_raster(request.path, request.variable, request.hint);
  if (request.period == 0 && !request.outside_is_nearest) { // before places are listed at steps of half a cell
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const Outline ends = outline_of(boundary, to_file, {infinite, infinite}, 0);
    check_cover(ends, cut_of(*file, ends, FieldRequest{}).cells, request.path);
  }
  const Outline outline = outline_of(boundary, to_file, {file->x().step, file->y().step}, request.period);
  const Cut cut = cut_of(*file, outline, request);
  if (!request.outside_is_nearest)
    check_cover(outline, cut.cells, request.path);
  check_smooth(cut, request);
  Raster raster = read_cut(*file, cut, request);
  if (request.fill == Fill::refuse)
    check_values(outline, raster, cut, *file, request.path);
  fill_with_nearest(raster);
  if (std::isnan(raster.value(0)))
    throw GeometryError(fmt::format("{}: expected data around the shape, found none", request.path));
  head = {raster.x,
          raster.y,
          !raster.singles.empty(),
          !raster.filled.empty(),
          (outline.box.min.x + outline.box.max.x) / 2,
          hash_of(raster)};
  return raster;
}

/// Sends a list from rank 0 in pieces. Collective.
template <class T>
void share(std::vector<T>& list, std::size_t size, const comm::Communicator& comm) {
  constexpr std::size_t piece = (std::size_t{1} << 25) / sizeof(T);
  comm::run_agreed(comm, [&] { list.resize(size); }); // the memory may not suffice
  for (std::size_t first = 0; comm.size() > 1 && first < size; first += piece) {
    const std::span<T> part(list.data() + first, std::min(piece, size - first));
    const auto bytes = std::as_bytes(part);
    const std::vector<std::byte> sent =
        comm.broadcast(comm.is_root() ? std::vector<std::byte>(bytes.begin(), bytes.end()) : std::vector<std::byte>());
    if (!comm.is_root())
      std::memcpy(part.data(), sent.data(), sent.size());
  }
}

/// Returns the value of rank 0. Collective.
template <class T>
T of_root(const T& value, const comm::Communicator& comm) {
  const auto bytes = std::as_bytes(std::span(&value, 1));
  const std::vector<std::byte> sent = comm.broadcast(std::vector<std::byte>(bytes.begin(), bytes.end()));
  T result;
  std::memcpy(&result, sent.data(), sizeof result);
  return result;
}

} // namespace

geometry::Box raster_box(const FieldRequest& request, const comm::Communicator& comm) {
  geometry::Box box;
  comm::run_agreed(comm, [&] {
    if (comm.is_root()) {
      const std::unique_ptr<RasterFile> file = open_raster(request.path, request.variable, request.hint);
      box = cells_of(file->x(), file->y());
    }
  });
  return of_root(box, comm);
}

ReadField read_field(const FieldRequest& request, const geometry::Boundary& boundary, const ToFile& to_file,
                     const comm::Communicator& comm) {
  Raster raster;
  Head head;
  comm::run_agreed(comm, [&] {
    if (comm.is_root())
      raster = read_on_root(request, boundary, to_file, head);
  });
  head = of_root(head, comm);
  raster.x = head.x;
  raster.y = head.y;
  const std::size_t size = raster.size();
  head.single ? share(raster.singles, size, comm) : share(raster.doubles, size, comm);
  if (head.has_filled)
    share(raster.filled, (size + 7) / 8, comm);
  std::optional<Raster> smooth;
  if (request.smooth > 0)
    comm::run_agreed(comm, [&] { smooth = smoothed(raster, reach_of(request, raster.x, raster.y)); });
  return {std::make_unique<const Field>(std::move(raster), request.period, head.middle, std::move(smooth)), head.hash,
          cell_of(request, head.x, head.y)};
}

} // namespace trime::fields
