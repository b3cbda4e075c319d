// SPDX-License-Identifier: BSD-3-Clause
// The options of the start, out of those of the run.
#pragma once

#include "start/start_options.hpp"
#include "trime/meshing/options.hpp"

namespace trime::meshing {

start::StartOptions plan_start(const MeshOptions& options);

} // namespace trime::meshing
