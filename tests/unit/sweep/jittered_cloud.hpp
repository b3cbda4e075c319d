// SPDX-License-Identifier: BSD-3-Clause
// Sites and kernels for tests of the vector kernels: some sites with their stars, all kernels, and one pass of a
// kernel.
#pragma once

#include "core/simd_level.hpp"
#include "delaunay/star_builder.hpp"
#include "support/point_sets.hpp"
#include "sweep/sweep_kernel.hpp"
#include "sweep/update_rule.hpp"
#include "unit/sweep/portable_sweep_kernels.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace trime::sweep {

using geometry::Vec2;
using mesh::Site;
using mesh::SiteList;
using sites::StarView;

constexpr double spacing = 0.03125, cap = 2.5;

class Ramp final : public sizing::SizeField {
public:
  double size(Vec2 p) const override { return spacing * (0.8 + 0.4 * p.x * p.y); }
};

/// Returns the kernels with all numbers of lanes, which run on every machine, and those that are compiled for this
/// machine.
inline std::vector<const SweepKernels*> kernels() {
  std::vector<const SweepKernels*> list{&kernels_portable, &portable_kernels_of_4_lanes, &portable_kernels_of_8_lanes};
#if defined(__x86_64__)
  if (simd_level() >= SimdLevel::avx2)
    list.push_back(&kernels_avx2);
  if (simd_level() >= SimdLevel::avx512)
    list.push_back(&kernels_avx512);
#endif
  return list;
}

/// A jittered lattice with its stars. Sites whose stars have gaps or many neighbours are left out, as in the sweeps. On
/// request some sites are held, as if they lay on a boundary, and sites next to them are bordered.
struct Cloud {
  Cloud(double jitter, bool is_graded, bool holds_some = false)
      : grid(geometry::Box{{0, 0}, {1, 1}}, {{}, {}, spacing}), points(grid) {
    SiteList sites = testing::hexagonal_lattice(24, spacing);
    for (std::size_t k = 0; k < sites.size(); ++k) {
      sites[k].position = testing::unit_lattice().snap(
          sites[k].position + (jitter * spacing) * (testing::random_vec2(4, k) - Vec2{0.5, 0.5}));
      sites[k].lead = (0.02 * spacing) * (testing::random_vec2(5, k) - Vec2{0.5, 0.5});
      if (holds_some && k % 11 == 0)
        sites[k].boundary = static_cast<std::int32_t>(k / 11);
    }
    points.assign_owned(sites, 0, grid.tile_count());
    if (!is_graded) {
      sizes = mesh::LocalSizes(spacing);
    } else {
      for (const Vec2 p : points.positions())
        sizes.values().push_back(Ramp().size(p));
    }
    compute();
    for (LocalIndex i = 0; i < points.owned(); ++i) {
      const auto ring = stars.ring(i);
      const bool whole = ring.size() >= 3 && ring.size() <= 8 && std::ranges::find(ring, delaunay::gap) == ring.end();
      const bool bordered =
          whole && std::ranges::any_of(ring, [&](LocalIndex neighbour) { return points.boundary(neighbour) >= 0; });
      classes.push_back(points.boundary(i) >= 0 ? SiteClass::held
                        : bordered              ? SiteClass::bordered
                        : whole                 ? SiteClass::local
                        : i % 2 || holds_some   ? SiteClass::exact
                                                : SiteClass::held);
    }
    size = is_graded ? static_cast<const sizing::SizeField*>(&ramp) : &uniform;
  }
  void compute() {
    stars.reset(points.owned());
    std::vector<mesh::BinRef> missing;
    delaunay::StarBuilder(testing::unit_lattice(), cap, 1).update(points, stars, sizes, {}, missing);
  }
  StarView view() const { return {points, stars, *size, &sizes}; }

  SweepTask task() {
    points.prepare_advance();
    SweepTask task;
    task.positions = points.positions().data();
    task.leads = points.leads().data();
    task.rings = stars.all_slots();
    task.degrees = stars.degrees();
    task.classes = classes.data();
    task.boundary = points.boundaries().data();
    task.sizes = sizes.is_uniform() ? nullptr : sizes.values().data();
    task.uniform_size = spacing;
    task.next_positions = points.next().positions().data();
    task.next_leads = points.next().leads().data();
    task.lattice_step = testing::unit_lattice().step();
    task.inverse_lattice_step = testing::unit_lattice().inverse_step();
    task.box = {{0, 0}, {1, 1}};
    task.cap_factor = cap;
    return task;
  }

  mesh::TileGrid grid;
  mesh::BinnedPoints points;
  delaunay::StarTable stars;
  mesh::LocalSizes sizes;
  std::vector<SiteClass> classes;
  sizing::UniformSize uniform{spacing};
  Ramp ramp;
  const sizing::SizeField* size;
};

struct Pass {
  explicit Pass(LocalIndex n)
      : suspects(static_cast<std::size_t>(n)), irregular(suspects.size()), guarded(suspects.size()) {}
  /// Runs a kernel on sites that are all awake.
  void run(const SweepKernels& kernel, const SweepTask& task, LocalIndex end) {
    flags.clear();
    for (LocalIndex i = 0; i < end; ++i)
      flags.push_back(task.classes[i] == SiteClass::held ? 0 : SiteFlags::awake | SiteFlags::watched);
    run_again(kernel, task, end);
  }
  /// Runs a kernel on sites whose flags were set before.
  void run_again(const SweepKernels& kernel, const SweepTask& task, LocalIndex end) {
    suspects.resize(flags.size());
    irregular.resize(flags.size());
    guarded.resize(flags.size());
    SweepTask here = task;
    here.flags = flags.data();
    SweepLeftovers leftovers{suspects.data(), irregular.data(), guarded.data()};
    tally = kernel.sweep(here, 0, end, leftovers);
    awake = leftovers.awake_count;
    suspects.resize(static_cast<std::size_t>(leftovers.suspect_count));
    irregular.resize(static_cast<std::size_t>(leftovers.irregular_count));
    guarded.resize(static_cast<std::size_t>(leftovers.guarded_count));
  }
  std::vector<LocalIndex> suspects, irregular, guarded;
  std::vector<std::uint8_t> flags;
  std::ptrdiff_t awake = 0;
  SweepTally tally;
};

inline std::vector<std::unique_ptr<UpdateRule>> rules() {
  std::vector<std::unique_ptr<UpdateRule>> list;
  list.push_back(std::make_unique<DistMeshRule>());
  list.push_back(std::make_unique<CvdRule>());
  list.push_back(std::make_unique<CvdRule>(3));
  list.push_back(std::make_unique<TriangleRule>());
  return list;
}

} // namespace trime::sweep
