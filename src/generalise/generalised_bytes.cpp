// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/generalised_bytes.hpp"

#include "comm/parcel.hpp"

#include <cstdint>

namespace trime::generalise {
namespace {

struct Head {
  polygon::Simplification counts;
  double area;
};

/// Stands for a loop; its pieces follow in a list of their own.
struct LoopHead {
  geometry::Vec2 winding;
  std::int32_t tag, is_outer;
};

} // namespace

std::vector<std::byte> to_bytes(const Generalised& all) {
  std::vector<LoopHead> loops;
  for (const geometry::Loop& loop : all.boundary.loops)
    loops.push_back({loop.winding, loop.tag, loop.outer});
  comm::Parcel parcel;
  parcel.add(std::vector<Head>{{all.counts, all.boundary.area}});
  parcel.add(loops);
  for (const geometry::Loop& loop : all.boundary.loops)
    parcel.add(loop.pieces);
  return parcel.release();
}

Generalised generalised_of_bytes(std::vector<std::byte> bytes, const geometry::Boundary& given) {
  comm::Parcel parcel(std::move(bytes));
  const Head head = parcel.take<Head>().at(0);
  Generalised all{{{}, given.part_names, head.area, given.periods, given.covers_torus}, head.counts};
  for (const LoopHead& loop : parcel.take<LoopHead>())
    all.boundary.loops.push_back({parcel.take<geometry::Piece>(), loop.is_outer != 0, loop.tag, loop.winding});
  return all;
}

} // namespace trime::generalise
