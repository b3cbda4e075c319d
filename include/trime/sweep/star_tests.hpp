// SPDX-License-Identifier: BSD-3-Clause
// Options that compute stars in slower ways, for tests. Plain data.
#pragma once

namespace trime::sweep {

/// Options for tests of the sweeps. The mesh is the same with each of them, with the exception of `sleepless`.
struct StarTests {
  /// Compares every star after every sweep with one that is computed from scratch. @throws InternalError if one differs
  bool verify = false;
  /// Certifies every star of every sweep by the empty-circle test, and not by the stars around it.
  bool by_emptiness = false;
  /// Keeps all tiles and sites awake in every sweep. The mesh may differ where a scale of the rule changes so little
  /// that it does not wake all sites.
  bool sleepless = false;
};

} // namespace trime::sweep
