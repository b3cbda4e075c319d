// SPDX-License-Identifier: BSD-3-Clause
// Compares the regions of a mesh with those of its config.
#pragma once

#include "checks.hpp"
#include "shape.hpp"

namespace trime_check {

/// A mesh file and what its regions should be.
struct GivenRegions {
  const StoredFile& file;
  const Mesh& mesh;
  const ConfigText& config;
  const Shape& shape;
  double simplified; ///< [h asked for] how far curves may stray where they were simplified
};

/// @brief Checks names, that triangles away from all curves lie in the first region that contains them, and that
/// interface edges follow the curves of parts. It does nothing if neither the config nor the file has regions.
void check_region_places(const GivenRegions& given, Report& report);

} // namespace trime_check
