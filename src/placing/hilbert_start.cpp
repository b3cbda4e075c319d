// SPDX-License-Identifier: BSD-3-Clause
#include "placing/hilbert_start.hpp"
#include "placing/lattice_start.hpp"

#include "core/random.hpp"
#include "core/thread_loop.hpp"
#include "placing/density_sampler.hpp"

#include <algorithm>
#include <cmath>

namespace trime::placing {
namespace {

using geometry::Vec2;
using polygon::BoundaryGuard;
__extension__ using Int128 = __int128;

/// Weights of the parts of this rank before each, and the total at the end.
/// @param kept receives the cells of each part; may be empty
std::vector<std::int64_t> weights_before(const comm::Communicator& comm, const DensityParts& parts,
                                         std::span<std::vector<DensitySampler::Cell>> kept) {
  std::vector<std::int64_t> before(static_cast<std::size_t>(parts.count()) + 1, 0);
  agreed_loop(comm, parts.count(), [&](std::ptrdiff_t part) {
    std::int64_t& weight = before[static_cast<std::size_t>(part) + 1];
    parts.for_each_cell(part, [&](const DensitySampler::Cell& cell) {
      weight += cell.weight;
      if (!kept.empty())
        kept[static_cast<std::size_t>(part)].push_back(cell);
    });
  });
  for (std::size_t part = 1; part < before.size(); ++part)
    before[part] += before[part - 1];
  return before;
}

} // namespace

class HilbertStart::Implementation {
public:
  Implementation(const comm::Communicator& comm, const mesh::TileRange& tiles, const BoundaryGuard& guard,
                 const sizing::SizeField& size, const geometry::Lattice& lattice, double expected, double coarsening,
                 const LoweredZones* zones)
      : comm_(comm), tiles_(tiles), lattice_(lattice),
        sampler_(tiles_.grid, guard, size, lattice_, coarsening, INFINITY, zones), parts_{tiles_, sampler_} {
    constexpr double few = 1 << 15; // sites whose cells are kept, about half a KiB each
    if (expected <= few)
      kept_.resize(static_cast<std::size_t>(parts_.count()));
    before_ = weights_before(comm, parts_, kept_);
    total_ = comm.sum(before_.back());
    first_ = comm.exclusive_scan(before_.back());
  }

  double wanted() const { return static_cast<double>(total_) / DensitySampler::weight_unit; }

  mesh::SiteList sites(std::int64_t n, std::uint64_t seed) const {
    if (total_ == 0 || n <= 0)
      return {};
    // Site j sits where the running weight passes (2j + 1) total / (2n).
    const auto sites_before = [&](std::int64_t weight) {
      return std::min(n, static_cast<std::int64_t>((Int128{2} * weight * n + total_ - 1) / (Int128{2} * total_)));
    };
    const std::int64_t first_site = sites_before(first_);
    mesh::SiteList all(static_cast<std::size_t>(sites_before(first_ + before_.back()) - first_site));
    agreed_loop(comm_, std::ssize(before_) - 1, [&](std::ptrdiff_t part) {
      std::int64_t running = first_ + before_[static_cast<std::size_t>(part)], j = sites_before(running);
      const auto visit = [&](const DensitySampler::Cell& cell) {
        const std::uint64_t stream = mix_bits(static_cast<std::uint64_t>(cell.level)) + cell.key;
        running += cell.weight;
        for (std::uint64_t slot = 0; j < n && (Int128{2} * j + 1) * total_ < Int128{2} * running * n; ++j, slot += 2) {
          const Vec2 p{
              cell.box.min.x + random_unit(seed, RandomPurpose::site_position, stream, slot) * cell.box.width(),
              cell.box.min.y + random_unit(seed, RandomPurpose::site_position, stream, slot + 1) * cell.box.height()};
          all[static_cast<std::size_t>(j - first_site)] = {lattice_.snap(p)};
        }
      };
      if (kept_.empty())
        parts_.for_each_cell(part, visit);
      else
        for (const DensitySampler::Cell& cell : kept_[static_cast<std::size_t>(part)])
          visit(cell);
    });
    return all;
  }

private:
  const comm::Communicator& comm_;
  mesh::TileRange tiles_;
  const geometry::Lattice& lattice_;
  DensitySampler sampler_;
  DensityParts parts_;
  std::vector<std::vector<DensitySampler::Cell>> kept_; // of each part; empty if they are not kept
  std::vector<std::int64_t> before_;                    // weights of the parts of this rank before each; all of them
  std::int64_t total_ = 0, first_ = 0;                  // weights over all ranks; before this rank
};

HilbertStart::HilbertStart(const comm::Communicator& comm, const mesh::TileRange& tiles, const BoundaryGuard& guard,
                           const sizing::SizeField& size, const geometry::Lattice& lattice, double expected,
                           double coarsening, const LoweredZones* zones)
    : implementation_(
          std::make_unique<const Implementation>(comm, tiles, guard, size, lattice, expected, coarsening, zones)) {}
HilbertStart::~HilbertStart() = default;

double HilbertStart::wanted() const {
  return implementation_->wanted();
}

mesh::SiteList HilbertStart::sites(std::int64_t n, std::uint64_t seed) const {
  return implementation_->sites(n, seed);
}

} // namespace trime::placing
