// SPDX-License-Identifier: BSD-3-Clause
// The ASCII grids of ESRI as data for sizes: read, filled, and looked up.
#include "contours/ascii_grid.hpp"
#include "fields/field.hpp"
#include "fields/nearest_fill.hpp"
#include "fuzz.hpp"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  fuzz::survives([&] {
    const contours::AsciiGrid grid = contours::read_ascii_grid(fuzz::text_of(data, size), "a.asc");
    if (grid.values.size() > 4096) // small ones find as much
      return;
    fields::Raster raster;
    raster.x = {grid.corner.x, grid.cell.x, grid.columns};
    raster.y = {grid.corner.y, grid.cell.y, grid.rows};
    raster.doubles = grid.values;
    fields::fill_with_nearest(raster);
    const fields::Field field(raster, 0, 0);
    for (int k = -2; k <= grid.columns; ++k) {
      const geometry::Vec2 p{raster.x.at(k + 0.3), raster.y.at(0.7 * k)};
      static_cast<void>(field.value(p));
      static_cast<void>(field.gradient(p));
    }
  });
  return 0;
}
