// SPDX-License-Identifier: BSD-3-Clause
// Makes OpenMP threads that wait for work go to sleep after a short time.
#pragma once

namespace trime::app {

/// @brief Restarts the program with environment variables that let waiting OpenMP threads sleep after about 10 us. Does
/// nothing if OMP_WAIT_POLICY or GOMP_SPINCOUNT is set, which is the case in the restarted program. Must be the first
/// call in main.
///
/// Why: by default a waiting thread of GCC's OpenMP spins for about a millisecond. A run that shares its cores with
/// another process then takes several times as long: 3.5 times for North America with 2e4 points (median of five
/// pairs). OpenMP reads the variables when it is loaded, before main begins, and has no function to change them later.
void shorten_waits(char** argv);

} // namespace trime::app
