// SPDX-License-Identifier: BSD-3-Clause
// Stores the state of a run as named numbers in a checkpoint. A class lists its members once, for both saving and
// restoring.
#pragma once

#include "trime/core/error.hpp"
#include "trime/core/sum.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <variant>

namespace trime {

/// Integers and floating-point numbers by name.
using StateNumbers = std::map<std::string, std::variant<std::int64_t, double>>;

/// @brief Copies members of classes into the named numbers of a state, or back.
class StateFields {
public:
  /// Copies members into `numbers`, which must outlive this object.
  static StateFields keeping(StateNumbers& numbers) { return {&numbers, nullptr}; }
  /// Sets members from `numbers`, which must outlive this object.
  static StateFields restoring(const StateNumbers& numbers) { return {nullptr, &numbers}; }

  bool restores() const { return from_ != nullptr; }

  /// @brief Saves or restores one member: an integer, a bool, an enum, a double or a FixedSum.
  /// @throws FileError if, while restoring, `numbers` has no number with this name and type
  template <class T>
  void field(const std::string& name, T& member) {
    if constexpr (std::is_same_v<T, FixedSum>) {
      FixedSum::Parts parts = member.split();
      field(name + "_low", parts.low);
      field(name + "_high", parts.high);
      if (restores())
        member = FixedSum::join(parts);
    } else {
      using Stored = std::conditional_t<std::is_floating_point_v<T>, double, std::int64_t>;
      if (restores())
        member = static_cast<T>(find<Stored>(name));
      else
        to_->insert_or_assign(name, static_cast<Stored>(member));
    }
  }

private:
  StateFields(StateNumbers* to, const StateNumbers* from) : to_(to), from_(from) {}
  template <class Stored>
  Stored find(const std::string& name) const {
    const auto found = from_->find(name);
    if (found == from_->end() || !std::holds_alternative<Stored>(found->second))
      throw FileError(
          fmt::format("the checkpoint has no number '{}' of the expected type; it is damaged, or of another "
                      "version of trime_mpi",
                      name));
    return std::get<Stored>(found->second);
  }

  StateNumbers* to_;
  const StateNumbers* from_;
};

} // namespace trime
