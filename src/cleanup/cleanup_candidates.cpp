// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup_candidates.hpp"

#include "cleanup/rules.hpp"
#include "core/random.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace trime::cleanup {
namespace {

using geometry::Vec2;

/// The worst first, in a few classes; then by the hash.
std::uint64_t order_of(double alpha, std::uint64_t hash) {
  constexpr int bits = 4;   // of the key, for the class
  std::uint64_t better = 0; // limits that it is below
  for (const double limit : CleanupRules::classes)
    better += alpha < limit;
  return (better << (64 - bits)) | (hash >> bits);
}

} // namespace

std::uint64_t hash_of(Vec2 place, int salt) {
  return mix_bits(mix_bits(std::bit_cast<std::uint64_t>(place.x) + static_cast<std::uint64_t>(salt)) ^
                  std::bit_cast<std::uint64_t>(place.y));
}

/// The key of the cell of a place, a few h wide, in its tile: the same on any number of ranks.
std::uint64_t CleanupCandidates::cell_key(Vec2 p, double h) const {
  int exponent = 0;
  std::frexp(h, &exponent);
  const Vec2 cell{std::floor(std::ldexp(p.x, -CleanupRules::contender_cell - exponent)),
                  std::floor(std::ldexp(p.y, -CleanupRules::contender_cell - exponent))};
  const mesh::Tile& tile = grid_.tile(grid_.tile_at(p));
  return mix_bits(hash_of(cell, exponent) + (std::uint64_t{tile.x} << 32 | tile.y));
}

void CleanupCandidates::set(const Candidate& candidate) {
  const auto [known, is_new] =
      entry_at_.try_emplace(hash_of(candidate.place, 0), static_cast<std::uint32_t>(entries_.size()));
  if (is_new)
    entries_.emplace_back();
  Entry& entry = entries_[known->second];
  entry.candidate = candidate;
  entry.cell = cell_key(candidate.place, candidate.size);
}

/// The entry stays in the list until there are many such.
void CleanupCandidates::drop(Vec2 place) {
  if (const auto known = entry_at_.find(hash_of(place, 0)); known != entry_at_.end())
    entries_[known->second] = {{place}};
}

void CleanupCandidates::settle(Vec2 place, int stage) {
  if (const auto known = entry_at_.find(hash_of(place, 0));
      known != entry_at_.end() && entries_[known->second].candidate.alpha > 0)
    entries_[known->second].settled = stage;
}

void CleanupCandidates::give_up(Vec2 place, int stage) {
  if (const auto known = entry_at_.find(hash_of(place, 0));
      known != entry_at_.end() && entries_[known->second].candidate.alpha > 0) {
    entries_[known->second].candidate.alpha = CleanupRules::bad_alpha;
    entries_[known->second].settled = stage;
  }
}

double CleanupCandidates::worst() const {
  double worst = 1;
  for (const Entry& entry : entries_)
    worst = std::max(worst, entry.candidate.alpha);
  return worst;
}

/// Removes the entries that are no longer candidates, once they are at least half of all.
void CleanupCandidates::forget_the_good() {
  const auto is_good = [](const Entry& entry) { return !(entry.candidate.alpha > 0); };
  if (2 * std::count_if(entries_.begin(), entries_.end(), is_good) < std::ssize(entries_))
    return;
  std::erase_if(entries_, is_good);
  entry_at_.clear();
  for (std::size_t k = 0; k < entries_.size(); ++k)
    entry_at_[hash_of(entries_[k].candidate.place, 0)] = static_cast<std::uint32_t>(k);
}

std::vector<Contender> CleanupCandidates::contenders(const ContenderRule& rule) {
  forget_the_good();
  std::unordered_map<std::uint64_t, const Candidate*> worst;
  for (const Entry& entry : entries_) {
    const Candidate& own = entry.candidate;
    if (!(own.alpha > rule.above) || entry.settled >= rule.stage ||
        !(rule.separation * own.size < rule.most_separation))
      continue;
    const auto [known, is_new] = worst.try_emplace(entry.cell, &own);
    const Candidate& other = *known->second;
    if (!is_new && (own.alpha > other.alpha ||
                    (own.alpha == other.alpha && geometry::lexicographically_less(own.place, other.place))))
      known->second = &own;
  }
  std::vector<Contender> contenders;
  contenders.reserve(worst.size());
  for (const auto& [cell, own] : worst)
    contenders.push_back(
        {own->place, rule.separation * own->size, order_of(own->alpha, hash_of(own->place, 1 + rule.round))});
  // The order of a map may differ from machine to machine.
  std::sort(contenders.begin(), contenders.end(),
            [](const Contender& a, const Contender& b) { return geometry::lexicographically_less(a.place, b.place); });
  return contenders;
}

} // namespace trime::cleanup
