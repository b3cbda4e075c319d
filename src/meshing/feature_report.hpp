// SPDX-License-Identifier: BSD-3-Clause
// What was done about features of the boundary that are smaller than the elements.
#pragma once

#include "meshing/layout.hpp"

namespace trime::meshing {

/// O(sites of the boundary)
FeatureReport report_features(const Layout& layout);

} // namespace trime::meshing
