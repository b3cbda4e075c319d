// SPDX-License-Identifier: BSD-3-Clause
// Slow ways to compute stars, for tests. Plain data.
#pragma once

namespace trime::sweep {

/// Tests of the sweeps; the mesh is the same with any of them, but for what `sleepless` says.
struct StarTests {
  /// Compare every star after every sweep with one that is computed anew. @throws InternalError if one differs
  bool verify = false;
  /// Certify every star of every sweep by emptiness, and none by those around it.
  bool by_emptiness = false;
  /// Keep all tiles and sites awake in every sweep. The mesh may differ where a scale of the rule changes by less than
  /// wakes all.
  bool sleepless = false;
};

} // namespace trime::sweep
