// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup_choice.hpp"

#include "cleanup/rules.hpp"
#include "core/gather.hpp"
#include "core/thread_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace trime::cleanup {
namespace {

using geometry::Vec2;

constexpr std::ptrdiff_t in_a_row = 64; // contenders that one thread looks at
enum class Decision : std::int32_t { open, chosen, excluded };

/// A contender of some rank.
struct RankedContender {
  Contender contender;
  std::int32_t rank, index;
  bool is_same(const RankedContender& other) const { return rank == other.rank && index == other.index; }
};
bool comes_before(const RankedContender& a, const RankedContender& b) {
  return a.rank != b.rank ? a.rank < b.rank : a.index < b.index;
}
/// What has become of a contender, for a rank that has a copy of it.
struct DecisionReport {
  std::int32_t rank, index;
  Decision decision;
};

bool is_first(const Contender& a, const Contender& b) {
  return a.order != b.order ? a.order < b.order : geometry::lexicographically_less(a.place, b.place);
}

/// The own contenders and copies of those of other ranks that some of them exclude.
class Choice {
public:
  Choice(const comm::Communicator& comm, const CleanupSites& sites, const geometry::Periods& periods,
         std::span<const Contender> contenders)
      : comm_(comm), periods_(periods), own_(contenders.size()) {
    for (std::size_t k = 0; k < own_; ++k)
      all_.push_back({contenders[k], comm.rank(), static_cast<std::int32_t>(k)});
    exchange_copies(sites);
    decisions_.assign(all_.size(), Decision::open);
    list_rivals();
  }

  void pass() {
    std::vector<Decision> next = decisions_;
    thread_loop(static_cast<std::ptrdiff_t>(own_), in_a_row, [&](std::ptrdiff_t item, int) {
      const auto k = static_cast<std::size_t>(item);
      if (decisions_[k] != Decision::open)
        return;
      bool first = true;
      for (const std::uint32_t r : rivals_of(k)) {
        if (decisions_[r] == Decision::chosen)
          next[k] = Decision::excluded;
        first &= decisions_[r] == Decision::excluded || is_first(all_[k].contender, all_[r].contender);
      }
      if (first && next[k] == Decision::open)
        next[k] = Decision::chosen;
    });
    decisions_ = std::move(next);
    exchange_reports();
  }

  std::vector<std::size_t> chosen() const {
    std::vector<std::size_t> list;
    for (std::size_t k = 0; k < own_; ++k)
      if (decisions_[k] == Decision::chosen)
        list.push_back(k);
    return list;
  }

private:
  template <class Place> // with a separation
  bool are_rivals(const Place& a, const Place& b) const {
    const double separation = std::max(a.separation, b.separation);
    return geometry::squared_length(periods_.nearest_image(b.place, a.place) - a.place) < separation * separation;
  }

  /// A contender whose separation reaches to the tiles of another rank is sent there; its rivals there are sent back.
  void exchange_copies(const CleanupSites& sites) {
    if (comm_.size() == 1)
      return;
    std::map<int, std::vector<RankedContender>> calls, answers;
    for (std::size_t k = 0; k < own_; ++k)
      for (const int rank : sites.ranks_near({all_[k].contender.place, all_[k].contender.separation})) {
        calls[rank].push_back(all_[k]);
        told_.push_back({rank, static_cast<std::int32_t>(k), Decision::open});
      }
    std::vector<RankedContender> copies = send(comm_, calls);
    for (const RankedContender& caller : copies)
      for (std::size_t k = 0; k < own_; ++k)
        if (are_rivals(all_[k].contender, caller.contender)) {
          answers[caller.rank].push_back(all_[k]);
          told_.push_back({caller.rank, static_cast<std::int32_t>(k), Decision::open});
        }
    const std::vector<RankedContender> answered = send(comm_, answers);
    copies.insert(copies.end(), answered.begin(), answered.end());
    std::sort(copies.begin(), copies.end(), comes_before);
    copies.erase(std::unique(copies.begin(), copies.end(),
                             [](const RankedContender& a, const RankedContender& b) { return a.is_same(b); }),
                 copies.end());
    all_.insert(all_.end(), copies.begin(), copies.end());
  }

  /// Pairs are found by the one with the larger separation, along x.
  void list_rivals() {
    struct Zone { // of a contender
      Vec2 place;
      double separation;
      std::uint32_t index;
    };
    std::vector<Zone> zones(all_.size()); // by x, in one piece
    for (std::size_t k = 0; k < zones.size(); ++k) {
      const Contender& own = all_[k].contender;
      zones[k] = {own.place, own.separation, static_cast<std::uint32_t>(k)};
    }
    std::sort(zones.begin(), zones.end(), [](const Zone& a, const Zone& b) { return a.place.x < b.place.x; });
    using Pair = std::array<std::uint32_t, 2>; // of indices, each once
    const std::vector<Pair> pairs =
        gather_in_order<Pair>(std::ssize(zones), in_a_row, [&](std::ptrdiff_t k, auto& list) {
          const Zone& own = zones[static_cast<std::size_t>(k)];
          const double reach_x = periods_.x > 0 ? INFINITY : own.separation;
          const double reach_y = periods_.y > 0 ? INFINITY : own.separation;
          auto other = std::lower_bound(zones.begin(), zones.end(), own.place.x - reach_x,
                                        [](const Zone& a, double x) { return a.place.x < x; });
          for (; other != zones.end() && other->place.x <= own.place.x + reach_x; ++other) {
            if (!(std::abs(other->place.y - own.place.y) <= reach_y))
              continue;
            const bool is_its_turn =
                own.separation > other->separation || (own.separation == other->separation && own.index < other->index);
            if (is_its_turn && are_rivals(own, *other))
              list.push_back({own.index, other->index});
          }
        });
    first_rival_.assign(all_.size() + 1, 0);
    for (const auto& [own, rival] : pairs) {
      ++first_rival_[own + 1];
      ++first_rival_[rival + 1];
    }
    std::partial_sum(first_rival_.begin(), first_rival_.end(), first_rival_.begin());
    rivals_.resize(2 * pairs.size());
    std::vector<std::uint32_t> next(first_rival_.begin(), first_rival_.end() - 1);
    for (const auto& [own, rival] : pairs) {
      rivals_[next[own]++] = rival;
      rivals_[next[rival]++] = own;
    }
  }
  std::span<const std::uint32_t> rivals_of(std::size_t k) const {
    return std::span(rivals_).subspan(first_rival_[k], first_rival_[k + 1] - first_rival_[k]);
  }

  void exchange_reports() {
    if (comm_.size() == 1)
      return;
    std::map<int, std::vector<DecisionReport>> reports;
    for (const DecisionReport& told : told_)
      reports[told.rank].push_back({comm_.rank(), told.index, decisions_[static_cast<std::size_t>(told.index)]});
    for (const DecisionReport& report : send(comm_, reports)) {
      const auto place = std::lower_bound(all_.begin() + static_cast<std::ptrdiff_t>(own_), all_.end(),
                                          RankedContender{{}, report.rank, report.index}, comes_before);
      decisions_[static_cast<std::size_t>(place - all_.begin())] = report.decision;
    }
  }

  const comm::Communicator& comm_;
  const geometry::Periods& periods_;
  std::size_t own_;                  // the first of all_
  std::vector<RankedContender> all_; // the others by rank and index
  std::vector<Decision> decisions_;
  std::vector<std::uint32_t> first_rival_, rivals_; // of each in all_, one after the other
  std::vector<DecisionReport> told_;                // which rank has a copy of which own one
};

} // namespace

std::vector<std::size_t> choose_apart(const comm::Communicator& comm, const CleanupSites& sites,
                                      const geometry::Periods& periods, std::span<const Contender> contenders) {
  Choice choice(comm, sites, periods, contenders);
  for (int pass = 0; pass < CleanupRules::passes; ++pass)
    choice.pass();
  return choice.chosen();
}

} // namespace trime::cleanup
