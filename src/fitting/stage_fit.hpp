// SPDX-License-Identifier: BSD-3-Clause
// The stage that is laid out at the size that a search has found.
#pragma once

#include "sites/stage.hpp"

#include <string>

namespace trime::fitting {

/// A stage without inner sites, and how many inner sites it should get.
struct StageFit {
  sites::Stage stage;
  double inner = 0;
  std::string shortage; ///< why there will be fewer points than asked for, or empty
};

} // namespace trime::fitting
