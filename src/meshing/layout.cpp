// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/layout.hpp"

#include "trime/comm/agree.hpp"
#include "trime/meshing/start.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

constexpr double row_height = 0.8660254037844386;
constexpr int boundary_rounds = 3, growth_rounds = 16, spacing_rounds = 12;
constexpr double same_spacing = 0.02;

/// Edge length of n nearly equilateral triangles' vertices on area A inside perimeter P: from V = (T + B)/2 + 1 with
/// T = A / (sqrt(3)/4 h^2) and B = P/h.
double estimated_size(double area, double perimeter, double n) {
  const double a = 2 * area / std::sqrt(3.0), b = perimeter / 2;
  return (b + std::sqrt(b * b + 4 * a * n)) / (2 * n);
}

class LayoutBuilder {
public:
  explicit LayoutBuilder(const LayoutContext& context) : context_(context), options_(context.options) {}

  Layout build() {
    const bool by_points = options_.points.has_value();
    double h = by_points ? estimated_size(context_.boundary.area, context_.boundary.length(),
                                          static_cast<double>(std::max<GlobalId>(3, *options_.points)))
                         : *options_.edge_length;
    for (int round = 0;; ++round) {
      lay_boundary(h);
      make_grid();
      if (!by_points || !uses_lattice())
        break;
      const double spacing = fitting_spacing();
      const bool comparable = spacing < 2 * layout_.edge_length; // else so few sites are wanted that it means nothing
      if (round + 1 == boundary_rounds || !comparable || std::abs(spacing / layout_.edge_length - 1) < same_spacing) {
        spacing_ = spacing;
        break;
      }
      h = spacing;
    }
    const int components = context_.boundary.components(), holes = context_.boundary.holes();
    context_.log.info("boundary: {} component{}, {} hole{}, {} sites, {} corners, h = {:.6g}", components,
                      components == 1 ? "" : "s", holes, holes == 1 ? "" : "s", layout_.boundary.sites.size(),
                      layout_.boundary.corners, layout_.edge_length);
    place_sites();
    return std::move(layout_);
  }

private:
  bool uses_lattice() const {
    return options_.start == Start::lattice ||
           (options_.start == Start::automatic && context_.relative_size.is_uniform());
  }
  GlobalId on_boundary() const { return static_cast<GlobalId>(layout_.boundary.sites.size()); }

  /// Sites on the boundary at size h, or at the next larger size at which they are not more than the points asked for.
  void lay_boundary(double h) {
    const auto time = context_.timers.scope("boundary");
    comm::run_agreed(context_.comm, [&] {
      GlobalId fewest = 0;
      for (int round = 0; round < growth_rounds; ++round, h *= 1.3) {
        layout_.edge_length = h;
        layout_.size = std::make_unique<sizing::ScaledSize>(context_.relative_size, h);
        layout_.boundary =
            make_boundary_sites(context_.boundary, *layout_.size, context_.lattice, options_.corner_angle);
        fewest = round == 0 ? on_boundary() : std::min(fewest, on_boundary());
        if (!options_.points || on_boundary() <= *options_.points) {
          layout_.guard = std::make_unique<BoundaryGuard>(layout_.boundary, context_.lattice);
          return;
        }
      }
      throw ConfigError(
          fmt::format("points = {} are too few for this shape: its boundary alone needs {} (every corner, and "
                      "every place where the boundary comes near itself, takes its own); ask for more",
                      *options_.points, fewest));
    });
  }

  /// The part of the container grid around the shape: what lies beyond holds no site. Cells that were given keep their
  /// size.
  void make_grid() {
    const geometry::Box& container = options_.container;
    geometry::Box around;
    for (const BoundarySite& site : layout_.boundary.sites)
      around.include(site.position);
    const double h = layout_.edge_length;
    const geometry::Box box{{std::max(container.min.x, around.min.x - h), std::max(container.min.y, around.min.y - h)},
                            {std::min(container.max.x, around.max.x + h), std::min(container.max.y, around.max.y + h)}};
    const auto cells = [](const std::optional<int>& given, double share) -> std::optional<int> {
      if (!given)
        return given;
      return std::max(1, static_cast<int>(std::lround(*given * share)));
    };
    layout_.state =
        std::make_unique<SiteState>(context_.comm, box,
                                    mesh::GridOptions{cells(options_.cells_x, box.width() / container.width()),
                                                      cells(options_.cells_y, box.height() / container.height()),
                                                      mean_spacing(), !context_.relative_size.is_uniform()});
  }

  /// Edge length at the mean density.
  double mean_spacing() const {
    return options_.points && !context_.relative_size.is_uniform()
               ? std::sqrt(context_.boundary.area / (row_height * static_cast<double>(*options_.points)))
               : layout_.edge_length;
  }

  /// The tiles that this rank fills with sites: an even share, before anything is known of their number.
  TileRange my_tiles() const {
    const mesh::TileGrid& grid = layout_.state->grid();
    const decomposition::Partition even(grid.tile_count(), context_.comm.size());
    return {grid, even.first_tile(context_.comm.rank()), even.last_tile(context_.comm.rank())};
  }

  /// @brief The smallest spacing found whose lattice has at most the wanted number of sites. The count falls like the
  /// inverse square of the spacing, in jumps where whole rows go: secant steps inside a bracket. All ranks take the
  /// same steps.
  double fitting_spacing() {
    const auto time = context_.timers.scope("start");
    const LatticeStart start(context_.boundary, *layout_.guard, context_.lattice);
    const TileRange tiles = my_tiles();
    const GlobalId wanted = *options_.points - on_boundary();
    const double none = 4 * (options_.container.width() + options_.container.height()); // no site fits at all
    // The discs of the boundary may leave no room at all, however fine the lattice (thin shapes, few points): nothing
    // below half the size of the boundary's segments is tried.
    double low = 0.5 * layout_.edge_length, high = none, spacing = layout_.edge_length;
    GlobalId best = 0;
    double stride = 0.002; // least relative step while no spacing is known that is large enough; doubles each time
    for (int round = 0; round < spacing_rounds && wanted - best > wanted / 5000; ++round) {
      const GlobalId count = context_.comm.sum(start.count(tiles, spacing));
      if (count > wanted) {
        low = spacing;
      } else if (count >= best) {
        high = spacing;
        best = count;
      }
      const double guess =
          spacing * std::sqrt((static_cast<double>(count) + 0.5) / (static_cast<double>(wanted) + 0.25));
      if (high == none) {
        spacing = std::max(guess, spacing * (1 + stride));
        stride *= 2;
      } else { // not too near an end of the bracket: the count jumps, and a secant alone would creep
        const double margin = 0.1 * (high - low);
        spacing = std::clamp(guess, low + margin, high - margin);
      }
    }
    return high;
  }

  std::vector<mesh::Site> inner_sites(const TileRange& tiles) const {
    if (uses_lattice())
      return LatticeStart(context_.boundary, *layout_.guard, context_.lattice)
          .sites(tiles, options_.points ? spacing_ : layout_.edge_length);
    const double h = layout_.edge_length, sites = static_cast<double>(on_boundary());
    const double n = options_.points ? static_cast<double>(*options_.points) - sites
                                     : context_.boundary.area / (row_height * h * h) - 0.5 * sites;
    return hilbert_start(context_.comm, tiles, *layout_.guard, *layout_.size, context_.lattice,
                         std::max<std::int64_t>(0, std::llround(n)), options_.seed);
  }

  void place_sites() {
    const auto time = context_.timers.scope("start");
    const TileRange tiles = my_tiles();
    std::vector<mesh::Site> sites = inner_sites(tiles);
    for (std::size_t b = 0; b < layout_.boundary.sites.size(); ++b) {
      const geometry::Vec2 p = layout_.boundary.sites[b].position;
      const LocalIndex tile = tiles.grid.place(p).tile;
      if (tile >= tiles.first && tile < tiles.last)
        sites.push_back({p, static_cast<std::int32_t>(b)});
    }
    layout_.state->distribute(std::move(sites));
    warn_of_shortage();
  }

  /// What a user would want to know before the sweeps begin.
  void warn_of_shortage() const {
    const GlobalId placed = context_.comm.sum(std::int64_t{layout_.state->points().owned()});
    if (options_.points && static_cast<double>(placed) < 0.95 * static_cast<double>(*options_.points) - 10)
      context_.log.warning(
          "asked for {} points, only {} fit: the discs of the {} boundary segments leave no room for more",
          *options_.points, placed, on_boundary());
    if (layout_.boundary.shortest < 0.1 * layout_.edge_length)
      context_.log.warning("the boundary has features down to {:.3g}, far below h = {:.3g}: expect small angles there",
                           layout_.boundary.shortest, layout_.edge_length);
  }

  const LayoutContext& context_;
  const MeshOptions& options_;
  Layout layout_;
  double spacing_ = 0; // of the lattice
};

} // namespace

Layout lay_out(const LayoutContext& context) {
  return LayoutBuilder(context).build();
}

} // namespace trime::meshing
