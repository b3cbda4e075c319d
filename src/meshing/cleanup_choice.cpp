// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/cleanup_choice.hpp"

#include "core/gather.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr int passes = 6;
constexpr std::ptrdiff_t in_a_row = 64; // contenders that one thread looks at
enum class Status : std::int32_t { open, chosen, out };

/// A contender of some rank.
struct Copy {
  Contender contender;
  std::int32_t rank, index;
  bool is_same(const Copy& other) const { return rank == other.rank && index == other.index; }
};
bool comes_before(const Copy& a, const Copy& b) {
  return a.rank != b.rank ? a.rank < b.rank : a.index < b.index;
}
struct Report {
  std::int32_t rank, index;
  Status status;
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
    status_.assign(all_.size(), Status::open);
    list_rivals();
  }

  void pass() {
    std::vector<Status> next = status_;
    thread_loop(static_cast<std::ptrdiff_t>(own_), in_a_row, [&](std::ptrdiff_t item, int) {
      const auto k = static_cast<std::size_t>(item);
      if (status_[k] != Status::open)
        return;
      bool first = true;
      for (const std::uint32_t r : rivals_of(k)) {
        if (status_[r] == Status::chosen)
          next[k] = Status::out;
        first &= status_[r] == Status::out || is_first(all_[k].contender, all_[r].contender);
      }
      if (first && next[k] == Status::open)
        next[k] = Status::chosen;
    });
    status_ = std::move(next);
    exchange_reports();
  }

  std::vector<std::size_t> chosen() const {
    std::vector<std::size_t> list;
    for (std::size_t k = 0; k < own_; ++k)
      if (status_[k] == Status::chosen)
        list.push_back(k);
    return list;
  }

private:
  template <class Place> // with a separation
  bool are_rivals(const Place& a, const Place& b) const {
    const double separation = std::max(a.separation, b.separation);
    return geometry::squared_length(periods_.nearest_image(b.place, a.place) - a.place) < separation * separation;
  }

  /// Who reaches to the tiles of another rank tells it; there, whoever is a rival answers.
  void exchange_copies(const CleanupSites& sites) {
    if (comm_.size() == 1)
      return;
    std::map<int, std::vector<Copy>> calls, answers;
    for (std::size_t k = 0; k < own_; ++k)
      for (const int rank : sites.ranks_near({all_[k].contender.place, all_[k].contender.separation})) {
        calls[rank].push_back(all_[k]);
        told_.push_back({rank, static_cast<std::int32_t>(k), Status::open});
      }
    std::vector<Copy> copies = send(comm_, calls);
    for (const Copy& caller : copies)
      for (std::size_t k = 0; k < own_; ++k)
        if (are_rivals(all_[k].contender, caller.contender)) {
          answers[caller.rank].push_back(all_[k]);
          told_.push_back({caller.rank, static_cast<std::int32_t>(k), Status::open});
        }
    const std::vector<Copy> answered = send(comm_, answers);
    copies.insert(copies.end(), answered.begin(), answered.end());
    std::sort(copies.begin(), copies.end(), comes_before);
    copies.erase(std::unique(copies.begin(), copies.end(), [](const Copy& a, const Copy& b) { return a.is_same(b); }),
                 copies.end());
    all_.insert(all_.end(), copies.begin(), copies.end());
  }

  /// Pairs are found by the one with the larger separation, along x.
  void list_rivals() {
    struct Item {
      Vec2 place;
      double separation;
      std::uint32_t index;
    };
    std::vector<Item> items(all_.size()); // by x, in one piece
    for (std::size_t k = 0; k < items.size(); ++k) {
      const Contender& own = all_[k].contender;
      items[k] = {own.place, own.separation, static_cast<std::uint32_t>(k)};
    }
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.place.x < b.place.x; });
    using Pair = std::array<std::uint32_t, 2>; // of indices, each once
    const std::vector<Pair> pairs =
        gather_in_order<Pair>(std::ssize(items), in_a_row, [&](std::ptrdiff_t k, auto& list) {
          const Item& own = items[static_cast<std::size_t>(k)];
          const double reach_x = periods_.x > 0 ? INFINITY : own.separation;
          const double reach_y = periods_.y > 0 ? INFINITY : own.separation;
          auto other = std::lower_bound(items.begin(), items.end(), own.place.x - reach_x,
                                        [](const Item& a, double x) { return a.place.x < x; });
          for (; other != items.end() && other->place.x <= own.place.x + reach_x; ++other) {
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
    std::map<int, std::vector<Report>> reports;
    for (const Report& told : told_)
      reports[told.rank].push_back({comm_.rank(), told.index, status_[static_cast<std::size_t>(told.index)]});
    for (const Report& report : send(comm_, reports)) {
      const auto place = std::lower_bound(all_.begin() + static_cast<std::ptrdiff_t>(own_), all_.end(),
                                          Copy{{}, report.rank, report.index}, comes_before);
      status_[static_cast<std::size_t>(place - all_.begin())] = report.status;
    }
  }

  const comm::Communicator& comm_;
  const geometry::Periods& periods_;
  std::size_t own_;       // the first of all_
  std::vector<Copy> all_; // the others by rank and index
  std::vector<Status> status_;
  std::vector<std::uint32_t> first_rival_, rivals_; // of each in all_, one after the other
  std::vector<Report> told_;                        // which rank has a copy of which own one
};

} // namespace

std::vector<std::size_t> choose_apart(const comm::Communicator& comm, const CleanupSites& sites,
                                      const geometry::Periods& periods, std::span<const Contender> contenders) {
  Choice choice(comm, sites, periods, contenders);
  for (int pass = 0; pass < passes; ++pass)
    choice.pass();
  return choice.chosen();
}

} // namespace trime::meshing
