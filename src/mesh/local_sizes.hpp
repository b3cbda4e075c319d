// SPDX-License-Identifier: BSD-3-Clause
// The element size h at the sites that a rank knows, by local index: read instead of evaluating the size field.
#pragma once

#include "trime/core/types.hpp"

#include <vector>

namespace trime::mesh {

/// One number if h is the same everywhere, else one for each site; or nothing yet.
class LocalSizes {
public:
  LocalSizes() = default;
  explicit LocalSizes(double uniform) : uniform_(uniform) {}
  explicit LocalSizes(std::vector<double> values) : values_(std::move(values)) {}

  /// False where no size has been computed since the sites changed.
  bool known(LocalIndex i) const { return uniform_ > 0 || static_cast<std::size_t>(i) < values_.size(); }
  bool is_uniform() const { return uniform_ > 0; }
  /// h at site i, domain units. @pre known(i)
  double operator[](LocalIndex i) const { return uniform_ > 0 ? uniform_ : values_[static_cast<std::size_t>(i)]; }

  const std::vector<double>& values() const { return values_; }
  /// The values by local index, to be filled; not used while the size is uniform.
  std::vector<double>& values() { return values_; }
  /// The sites have changed.
  void forget() {
    uniform_ = 0;
    values_.clear();
  }

private:
  double uniform_ = 0; // 0: not uniform
  std::vector<double> values_;
};

} // namespace trime::mesh
