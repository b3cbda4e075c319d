// SPDX-License-Identifier: BSD-3-Clause
// Slow ways to compute stars, for tests. Plain data.
#pragma once

namespace trime::sweep {

/// Tests of the sweeps; the mesh is the same with any of them.
struct StarTests {
  /// Compare every star after every sweep with one that is computed anew. @throws InternalError if one differs
  bool verify = false;
  /// Certify every star of every sweep by emptiness, and none by those around it.
  bool by_emptiness = false;
};

} // namespace trime::sweep
