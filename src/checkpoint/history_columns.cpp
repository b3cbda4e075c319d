// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint/history_columns.hpp"

#include <cstdint>
#include <type_traits>

namespace trime::checkpoint {
namespace {

using sweep::SweepRecord;

/// Shows the name of every member of a record, and where it is, to `visit`.
template <class Visit>
void for_each_member(const Visit& visit) {
  visit("sweep", &SweepRecord::sweep);
  visit("points", &SweepRecord::points);
  visit("stage", &SweepRecord::stage);
  visit("by_bars", &SweepRecord::by_bars);
  visit("median_alpha", &SweepRecord::median_alpha);
  visit("mean_alpha", &SweepRecord::mean_alpha);
  visit("max_alpha", &SweepRecord::max_alpha);
  visit("max_move", &SweepRecord::max_move);
  visit("moving_share", &SweepRecord::moving_share);
  visit("rebuilt_stars", &SweepRecord::rebuilt_stars);
  visit("pushed", &SweepRecord::pushed);
  visit("deleted", &SweepRecord::deleted);
  visit("seconds", &SweepRecord::seconds);
}

template <class T>
using Stored = std::conditional_t<std::is_floating_point_v<T>, double, std::int64_t>;

} // namespace

io::MetadataGroup columns_of(const std::vector<SweepRecord>& history) {
  io::MetadataGroup group{"history", {}, {}};
  for_each_member([&]<class T>(const char* name, T SweepRecord::*member) {
    std::vector<Stored<T>> values;
    for (const SweepRecord& record : history)
      values.push_back(static_cast<Stored<T>>(record.*member));
    group.columns.push_back({name, std::move(values)});
  });
  return group;
}

std::vector<SweepRecord> history_of(const io::Metadata& metadata) {
  std::vector<SweepRecord> history(column<std::int64_t>(metadata, "history", "sweep").size());
  for_each_member([&]<class T>(const char* name, T SweepRecord::*member) {
    const std::vector<Stored<T>>& values = column<Stored<T>>(metadata, "history", name);
    if (values.size() != history.size())
      throw FileError(fmt::format("the checkpoint is damaged: its history has {} values of {}, expected {}",
                                  values.size(), name, history.size()));
    for (std::size_t k = 0; k < values.size(); ++k)
      history[k].*member = static_cast<T>(values[k]);
  });
  return history;
}

void add(const std::vector<SweepRecord>& history, ContentHash& hash) {
  for (const SweepRecord& record : history)
    for_each_member(
        [&]<class T>(const char*, T SweepRecord::*member) { hash.add(static_cast<Stored<T>>(record.*member)); });
}

} // namespace trime::checkpoint
