// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/remembered_size.hpp"

#include "core/random.hpp"
#include "sizing/size_blocks.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace trime::sizing {
namespace {

using geometry::Vec2;

// [1] Slots for each place that is kept, at least: more make the searches shorter, and the table larger.
constexpr std::size_t slots_per_place = 2;

std::uint64_t hash_of(Vec2 p) {
  return mix_bits(std::bit_cast<std::uint64_t>(p.x) ^ mix_bits(std::bit_cast<std::uint64_t>(p.y)));
}

/// Zeros of both signs are different places, as in the hash.
bool is_same(Vec2 a, Vec2 b) {
  return std::bit_cast<std::uint64_t>(a.x) == std::bit_cast<std::uint64_t>(b.x) &&
         std::bit_cast<std::uint64_t>(a.y) == std::bit_cast<std::uint64_t>(b.y);
}

} // namespace

/// The slot with this place, or the free one where it belongs. @pre there are slots
std::size_t RememberedSize::slot_of(Vec2 p) const {
  const std::size_t last = slots_.size() - 1;
  std::size_t k = static_cast<std::size_t>(hash_of(p)) & last;
  while (slots_[k].is_taken && !is_same(slots_[k].place, p)) // ends, since at most half of the slots are taken
    k = (k + 1) & last;
  return k;
}

void RememberedSize::make_room(std::size_t more) {
  const std::size_t wanted = std::bit_ceil(slots_per_place * (taken_ + more));
  if (wanted <= slots_.size())
    return;
  const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(wanted));
  for (const Slot& slot : old)
    if (slot.is_taken)
      slots_[slot_of(slot.place)] = slot;
}

void RememberedSize::remember(std::span<const Vec2> places) {
  if (is_uniform())
    return;
  std::vector<Vec2> fresh;
  for (const Vec2 p : places)
    if (slots_.empty() || !slots_[slot_of(p)].is_taken)
      fresh.push_back(p);
  std::vector<double> values(fresh.size());
  loop_over_blocks(field_, std::ssize(fresh), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    const auto first = static_cast<std::size_t>(begin), count = static_cast<std::size_t>(end - begin);
    field_.sizes(std::span(fresh).subspan(first, count), std::span(values).subspan(first, count));
  });
  if (fresh.empty())
    return;
  make_room(fresh.size());
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    Slot& slot = slots_[slot_of(fresh[k])];
    taken_ += slot.is_taken ? 0 : 1;
    slot = {fresh[k], values[k], true};
  }
}

double RememberedSize::size(Vec2 p) const {
  if (!slots_.empty())
    if (const Slot& slot = slots_[slot_of(p)]; slot.is_taken)
      return slot.size;
  return field_.size(p);
}

/// Asks the field together for those that are not known.
void RememberedSize::sizes(std::span<const Vec2> places, std::span<double> values) const {
  std::vector<Vec2> unknown;
  std::vector<std::size_t> at;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!slots_.empty())
      if (const Slot& slot = slots_[slot_of(places[k])]; slot.is_taken) {
        values[k] = slot.size;
        continue;
      }
    unknown.push_back(places[k]);
    at.push_back(k);
  }
  const std::vector<double> found = sizes_at(field_, unknown);
  for (std::size_t k = 0; k < found.size(); ++k)
    values[at[k]] = found[k];
}

std::size_t RememberedSize::memory_bytes() const {
  return slots_.capacity() * sizeof(Slot);
}

} // namespace trime::sizing
