// SPDX-License-Identifier: BSD-3-Clause
// The certificate of a mesh: named checks, each with an expected and a found number.
#pragma once

#include <string>
#include <vector>

namespace trime::mesh {

/// One check.
struct Check {
  std::string name; ///< lower case with underscores, also the name in the file
  double expected = 0;
  double found = 0;
  bool passed = false;
  std::string meaning; ///< one line for the report
};

using Checks = std::vector<Check>;

inline bool all_passed(const Checks& checks) {
  for (const Check& check : checks)
    if (!check.passed)
      return false;
  return true;
}

} // namespace trime::mesh
