// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup_choice.hpp"

#include "cleanup/rules.hpp"
#include "core/thread_loop.hpp"
#include "geometry/box_tree.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <vector>

namespace trime::cleanup {
namespace {

using geometry::Vec2;

/// @brief Canonical places in a tree, images across a periodic border included. However they lie, a search is
/// O(log n + found).
class PlaceIndex {
public:
  /// O(n log n). The periods and the places must outlive the object.
  PlaceIndex(const geometry::Periods& periods, std::span<const geometry::Vec2> places)
      : periods_(periods), places_(places), tree_(boxes_of(places)) {}

  /// @brief Calls visit(index) for each of the places whose nearest image lies within `reach` of `center`.
  /// @pre `center` canonical, reach below half a period
  template <class Visit>
  void for_each_near(geometry::Vec2 center, double reach, const Visit& visit) const {
    for (const int i : {0, -1, 1})
      for (const int j : {0, -1, 1})
        if ((i == 0 || periods_.x > 0) && (j == 0 || periods_.y > 0))
          visit_image(center, center + geometry::Vec2{i * periods_.x, j * periods_.y}, reach, visit);
  }

private:
  static std::vector<geometry::Box> boxes_of(std::span<const geometry::Vec2> places) {
    std::vector<geometry::Box> boxes;
    for (const geometry::Vec2 place : places)
      boxes.push_back({place, place});
    return boxes;
  }
  template <class Visit>
  void visit_image(geometry::Vec2 center, geometry::Vec2 image, double reach, const Visit& visit) const {
    const geometry::Vec2 corner{reach, reach};
    tree_.for_each_meeting({image - corner, image + corner}, [&](std::size_t k) {
      if (geometry::squared_length(periods_.nearest_image(places_[k], center) - center) < reach * reach)
        visit(static_cast<std::uint32_t>(k));
    });
  }

  const geometry::Periods& periods_;
  const std::span<const geometry::Vec2> places_;
  const geometry::BoxTree tree_;
};

constexpr std::ptrdiff_t in_a_row = 64; // contenders that one thread looks at
enum class Decision : std::int32_t { open, chosen, excluded };

bool comes_before(const ChosenContender& a, const ChosenContender& b) {
  return a.rank != b.rank ? a.rank < b.rank : a.number < b.number;
}
bool is_same(const ChosenContender& a, const ChosenContender& b) {
  return a.rank == b.rank && a.number == b.number;
}
bool is_first(const Contender& a, const Contender& b) {
  return a.order != b.order ? a.order < b.order : geometry::lexicographically_less(a.place, b.place);
}

/// The state of a contender, for a rank that has a copy of it.
struct DecisionReport {
  std::int32_t number;
  Decision decision;
};

/// The own contenders and copies of those of other ranks that some of them exclude.
class Chooser {
public:
  Chooser(const comm::Communicator& comm, const comm::Neighbours& neighbours, const CleanupSites& sites,
          const geometry::Periods& periods, std::span<const Contender> contenders)
      : comm_(comm), periods_(periods), own_(contenders.size()) {
    for (std::size_t k = 0; k < own_; ++k)
      all_.push_back({contenders[k], comm.rank(), static_cast<std::int32_t>(k)});
    if (comm.size() > 1)
      exchange_copies(neighbours, sites);
    decisions_.assign(all_.size(), Decision::open);
    list_rivals();
  }

  void pass() {
    const std::vector<int> peers = open_peers();
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
    exchange_reports(peers);
  }

  Choice result() const {
    Choice choice;
    choice.is_whole = is_whole_;
    for (std::size_t k = 0; k < own_; ++k)
      if (decisions_[k] == Decision::chosen)
        choice.own.push_back(all_[k]);
    for (const auto& [rank, called] : called_)
      if (std::any_of(called.begin(), called.end(), [&](std::int32_t k) { return is_chosen(at(k)); }))
        choice.partners.push_back(rank);
    for (const ChosenContender& caller : callers_)
      if (is_chosen(copy(caller.rank, caller.number))) {
        choice.near.push_back(caller);
        choice.partners.push_back(caller.rank);
      }
    std::sort(choice.partners.begin(), choice.partners.end());
    choice.partners.erase(std::unique(choice.partners.begin(), choice.partners.end()), choice.partners.end());
    return choice;
  }

private:
  /// A contender whose separation reaches to the tiles of a neighbour is sent there; those within it are sent back.
  void exchange_copies(const comm::Neighbours& neighbours, const CleanupSites& sites) {
    for (std::size_t k = 0; k < own_; ++k)
      for (const int rank : sites.ranks_near({all_[k].contender.place, all_[k].contender.separation}))
        if (neighbours.contains(rank))
          called_[rank].push_back(static_cast<std::int32_t>(k));
        else
          is_whole_ = false;
    told_ = called_;
    callers_ = send_contenders(neighbours.ranks(), called_);
    std::vector<ChosenContender> copies = callers_;
    const std::map<int, std::vector<std::int32_t>> answers = find_answers();
    std::vector<int> peers; // one of the two has called the other
    for (const int rank : neighbours.ranks())
      if (called_.contains(rank) || std::any_of(callers_.begin(), callers_.end(),
                                                [&](const ChosenContender& caller) { return caller.rank == rank; }))
        peers.push_back(rank);
    const std::vector<ChosenContender> answered = send_contenders(peers, answers);
    for (const auto& [rank, list] : answers)
      told_[rank].insert(told_[rank].end(), list.begin(), list.end());
    copies.insert(copies.end(), answered.begin(), answered.end());
    std::sort(copies.begin(), copies.end(), comes_before);
    copies.erase(std::unique(copies.begin(), copies.end(), is_same), copies.end());
    all_.insert(all_.end(), copies.begin(), copies.end());
  }

  /// The own ones that lie in the separation of a caller and have not called it.
  std::map<int, std::vector<std::int32_t>> find_answers() const {
    const std::vector<Vec2> all_places = places();
    const PlaceIndex index(periods_, all_places);
    std::map<int, std::vector<std::int32_t>> answers;
    for (const ChosenContender& caller : callers_)
      index.for_each_near(caller.contender.place, caller.contender.separation,
                          [&](std::uint32_t k) { answers[caller.rank].push_back(static_cast<std::int32_t>(k)); });
    for (auto& [rank, list] : answers) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      if (const auto called = called_.find(rank); called != called_.end())
        std::erase_if(
            list, [&](std::int32_t k) { return std::binary_search(called->second.begin(), called->second.end(), k); });
    }
    return answers;
  }

  std::vector<Vec2> places() const {
    std::vector<Vec2> places;
    for (const ChosenContender& one : all_)
      places.push_back(one.contender.place);
    return places;
  }

  /// Sends own contenders to some of the peers. @return what the peers send
  std::vector<ChosenContender> send_contenders(std::span<const int> peers,
                                               const std::map<int, std::vector<std::int32_t>>& numbers) const {
    std::vector<comm::Message> outgoing;
    for (const auto& [rank, list] : numbers) {
      std::vector<ChosenContender> contenders;
      for (const std::int32_t k : list)
        contenders.push_back(all_[at(k)]);
      outgoing.push_back({rank, comm::to_bytes(std::span<const ChosenContender>(contenders))});
    }
    std::vector<ChosenContender> arrived;
    for (const comm::Message& message : comm::exchange_among(comm_, peers, outgoing))
      for (const ChosenContender& contender : comm::from_bytes<ChosenContender>(message.data))
        arrived.push_back(contender);
    return arrived;
  }

  /// Pairs are found by the one with the larger separation.
  void list_rivals() {
    const std::vector<Vec2> all_places = places();
    const PlaceIndex index(periods_, all_places);
    using Pair = std::array<std::uint32_t, 2>; // of indices, each once
    const std::vector<Pair> pairs =
        gather_in_order<Pair>(std::ssize(all_), in_a_row, [&](std::ptrdiff_t item, auto& list) {
          const auto k = static_cast<std::uint32_t>(item);
          const double separation = all_[k].contender.separation;
          index.for_each_near(all_places[k], separation, [&](std::uint32_t other) {
            const double its = all_[other].contender.separation;
            if (separation > its || (separation == its && k < other))
              list.push_back({k, other});
          });
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

  /// Where the copy of a contender of another rank stands in all_, if there is one.
  std::size_t copy(int rank, std::int32_t number) const {
    const auto place = std::lower_bound(all_.begin() + static_cast<std::ptrdiff_t>(own_), all_.end(),
                                        ChosenContender{{}, rank, number}, comes_before);
    return static_cast<std::size_t>(place - all_.begin());
  }
  bool is_open(std::size_t k) const { return decisions_[k] == Decision::open; }
  bool is_chosen(std::size_t k) const { return decisions_[k] == Decision::chosen; }

  /// Ranks with which some contender is shared that is open: both know which these are.
  std::vector<int> open_peers() const {
    std::vector<int> peers;
    for (const auto& [rank, numbers] : told_)
      if (std::any_of(numbers.begin(), numbers.end(), [&](std::int32_t k) { return is_open(at(k)); }))
        peers.push_back(rank);
    for (std::size_t k = own_; k < all_.size(); ++k)
      if (is_open(k))
        peers.push_back(all_[k].rank);
    std::sort(peers.begin(), peers.end());
    peers.erase(std::unique(peers.begin(), peers.end()), peers.end());
    return peers;
  }

  void exchange_reports(std::span<const int> peers) {
    std::vector<comm::Message> reports;
    for (const int rank : peers)
      if (const auto told = told_.find(rank); told != told_.end()) {
        std::vector<DecisionReport> list;
        for (const std::int32_t k : told->second)
          list.push_back({k, decisions_[at(k)]});
        reports.push_back({rank, comm::to_bytes(std::span<const DecisionReport>(list))});
      }
    for (const comm::Message& message : comm::exchange_among(comm_, peers, reports))
      for (const DecisionReport& report : comm::from_bytes<DecisionReport>(message.data))
        decisions_[copy(message.peer, report.number)] = report.decision;
  }

  const comm::Communicator& comm_;
  const geometry::Periods& periods_;
  std::size_t own_;                                 // the first of all_
  std::vector<ChosenContender> all_;                // the others by rank and number
  std::vector<ChosenContender> callers_;            // of other ranks: they reach to tiles of this one
  std::map<int, std::vector<std::int32_t>> called_; // by rank: the own ones that reach to its tiles
  std::map<int, std::vector<std::int32_t>> told_;   // by rank: the contenders of this rank that it has a copy of
  std::vector<Decision> decisions_;                 // by index in all_
  std::vector<std::uint32_t> first_rival_, rivals_; // of each in all_, one after the other
  bool is_whole_ = true;
};

} // namespace

Choice choose_apart(const comm::Communicator& comm, const comm::Neighbours& neighbours, const CleanupSites& sites,
                    const geometry::Periods& periods, std::span<const Contender> contenders) {
  Chooser chooser(comm, neighbours, sites, periods, contenders);
  for (int pass = 0; pass < CleanupRules::passes; ++pass)
    chooser.pass();
  return chooser.result();
}

} // namespace trime::cleanup
