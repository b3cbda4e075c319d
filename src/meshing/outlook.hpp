// SPDX-License-Identifier: BSD-3-Clause
// Estimates what a run will do to the shape.
#pragma once

#include "meshing/run_context.hpp"
#include "trime/meshing/mesher.hpp"

namespace trime::meshing {

/// See Mesher::outlook. Collective.
Outlook look_ahead(const RunContext& run);

} // namespace trime::meshing
