// SPDX-License-Identifier: BSD-3-Clause
// Translates the options of the mesher to the options of the modules that it uses.
#pragma once

#include "cleanup/cleanup.hpp"
#include "fitting/fit_options.hpp"
#include "start/point_scheme.hpp"
#include "sweep/stopping.hpp"
#include "trime/meshing/options.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::meshing {

/// @param size decides whether absolute sizes are one length
fitting::FitOptions fit_options(const MeshOptions& options, const sizing::SizeField& size);
/// @param old the points of an old mesh; null: the sites start at new places
start::StartOptions start_options(const MeshOptions& options, const start::OldPoints* old = nullptr);
sweep::SweepOptions sweep_options(const MeshOptions& options);
cleanup::CleanupOptions cleanup_options(const MeshOptions& options);

} // namespace trime::meshing
