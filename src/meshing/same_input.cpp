// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/same_input.hpp"

#include "comm/agree.hpp"
#include "core/random.hpp"
#include "core/simd_level.hpp"
#include "meshing/rules.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <bit>

namespace trime::meshing {
namespace {

using geometry::Boundary;
using geometry::Loop;
using geometry::Piece;

/// A hash of numbers in their order.
class Hash {
public:
  void add(double value) { value_ = mix_bits(value_ ^ std::bit_cast<std::uint64_t>(value)); }
  void add(geometry::Vec2 p) {
    add(p.x);
    add(p.y);
  }
  std::int64_t value() const { return static_cast<std::int64_t>(value_); }

private:
  std::uint64_t value_ = 0;
};

void add(const Piece& piece, Hash& hash) {
  hash.add(piece.start);
  hash.add(piece.end);
  hash.add(piece.part);
  hash.add(piece.corner ? 1 : 0);
  if (!piece.circular)
    return;
  hash.add(piece.center);
  hash.add(piece.radius);
  hash.add(piece.start_angle);
  hash.add(piece.sweep);
}

std::int64_t hash_of(const geometry::Domain& domain) {
  Hash hash;
  hash.add(domain.frame().container().min);
  hash.add(domain.frame().container().max);
  const Boundary& boundary = domain.boundary();
  hash.add({boundary.periods.x, boundary.periods.y});
  for (const Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces)
      add(piece, hash);
  for (const geometry::InnerArc& arc : domain.curves().arcs)
    for (const Piece& piece : arc.pieces)
      add(piece, hash);
  for (const geometry::FixedPoint& point : domain.fixed_points())
    hash.add(point.position);
  return hash.value();
}

/// At the starts of pieces, evenly over all of them: places where every size is asked for anyway.
std::int64_t hash_of_sizes(const Boundary& boundary, const sizing::SizeField& size) {
  std::size_t pieces = 0, next = 0;
  for (const Loop& loop : boundary.loops)
    pieces += loop.pieces.size();
  const std::size_t stride = std::max<std::size_t>(1, pieces / MeshingRules::compared_sizes);
  Hash hash;
  for (const Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces)
      if (next++ % stride == 0)
        hash.add(sizing::checked_size(size, boundary.periods.wrap(piece.start)));
  return hash.value();
}

/// Throws on all ranks. Collective.
void check_same(std::int64_t hash, const char* what, const comm::Communicator& comm) {
  const std::int64_t least = comm.min(hash), most = comm.max(hash);
  if (least != most)
    throw InternalError(
        fmt::format("the ranks compute different bits of the {}: expected one hash, found {:016x} and {:016x}; use "
                    "nodes with the same processors and libraries, and a size that does not depend on the rank",
                    what, static_cast<std::uint64_t>(least), static_cast<std::uint64_t>(most)));
}

} // namespace

InputHashes check_same_input(const geometry::Domain& domain, const sizing::SizeField& size,
                             const comm::Communicator& comm) {
  std::int64_t sizes = 0;
  comm::run_agreed(comm, [&] {
    if (const std::string fault = arithmetic_fault(); !fault.empty())
      throw InternalError(
          "the floating-point self-test failed, so this build would make different meshes on this machine: " + fault);
    sizes = hash_of_sizes(domain.boundary(), size);
  });
  const std::int64_t shape = hash_of(domain);
  check_same(shape, "shape", comm);
  check_same(sizes, "size field", comm);
  return {shape, sizes};
}

} // namespace trime::meshing
