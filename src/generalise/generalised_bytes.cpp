// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/generalised_bytes.hpp"

#include "trime/core/error.hpp"

#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::Boundary;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

struct Head {
  polygon::Simplification counts;
  double area;
  std::uint64_t loops;
};

/// Stands for a loop; its pieces follow.
struct LoopHead {
  Vec2 winding;
  std::uint64_t pieces;
  std::int32_t tag, is_outer;
};

template <class T>
void append(std::span<const T> values, std::string& bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}
template <class T>
void append(const T& value, std::string& bytes) {
  append(std::span<const T>(&value, 1), bytes);
}

/// Takes values out in the order in which they were appended.
class Reader {
public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}

  template <class T>
  void take(std::span<T> values) {
    TRIME_ASSERT(values.size_bytes() <= bytes_.size() - next_, "{} bytes of curves end within {} more", bytes_.size(),
                 values.size_bytes());
    if (!values.empty())
      std::memcpy(values.data(), bytes_.data() + next_, values.size_bytes());
    next_ += values.size_bytes();
  }
  template <class T>
  T take() {
    T value;
    take(std::span<T>(&value, 1));
    return value;
  }

private:
  const std::string& bytes_;
  std::size_t next_ = 0;
};

} // namespace

std::string to_bytes(const Generalised& all) {
  std::string bytes;
  const std::vector<Loop>& loops = all.boundary.loops;
  bytes.reserve(sizeof(Head) + loops.size() * sizeof(LoopHead) +
                static_cast<std::size_t>(polygon::piece_count(all.boundary)) * sizeof(Piece));
  append(Head{all.counts, all.boundary.area, loops.size()}, bytes);
  for (const Loop& loop : loops) {
    append(LoopHead{loop.winding, loop.pieces.size(), loop.tag, loop.outer}, bytes);
    append(std::span<const Piece>(loop.pieces), bytes);
  }
  return bytes;
}

Generalised generalised_of_bytes(const std::string& bytes, const Boundary& given) {
  Reader reader(bytes);
  const auto head = reader.take<Head>();
  Generalised all{{{}, given.part_names, head.area, given.periods, given.covers_torus}, head.counts};
  for (std::uint64_t k = 0; k < head.loops; ++k) {
    const auto loop = reader.take<LoopHead>();
    all.boundary.loops.push_back({std::vector<Piece>(loop.pieces), loop.is_outer != 0, loop.tag, loop.winding});
    reader.take(std::span<Piece>(all.boundary.loops.back().pieces));
  }
  return all;
}

} // namespace trime::generalise
