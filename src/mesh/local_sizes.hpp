// SPDX-License-Identifier: BSD-3-Clause
// Caches the element size h at the sites that a rank knows, so that the size field need not be evaluated again.
#pragma once

#include "trime/core/types.hpp"

#include <vector>

namespace trime::mesh {

/// Holds one number if h is the same everywhere, otherwise one for each site, or none before they are computed.
class LocalSizes {
public:
  LocalSizes() = default;
  explicit LocalSizes(double uniform) : uniform_(uniform) {}
  explicit LocalSizes(std::vector<double> values) : values_(std::move(values)) {}

  /// Returns false if the size of site i has not been computed since the sites changed.
  bool known(LocalIndex i) const { return uniform_ > 0 || static_cast<std::size_t>(i) < values_.size(); }
  bool is_uniform() const { return uniform_ > 0; }
  /// Returns h at site i in domain units. @pre known(i)
  double operator[](LocalIndex i) const { return uniform_ > 0 ? uniform_ : values_[static_cast<std::size_t>(i)]; }

  const std::vector<double>& values() const { return values_; }
  /// Returns the values by local index, which the caller fills. They are not used while the size is uniform.
  std::vector<double>& values() { return values_; }
  /// Forgets all sizes after the sites have changed.
  void forget() {
    uniform_ = 0;
    values_.clear();
  }

private:
  double uniform_ = 0; // 0: not uniform
  std::vector<double> values_;
};

} // namespace trime::mesh
