// SPDX-License-Identifier: BSD-3-Clause
// Lets threads of OpenMP that wait for work sleep soon.
#pragma once

namespace trime::app {

/// @brief Starts the program again, with variables that let waiting threads of OpenMP sleep after about 10 us. Does
/// nothing if the user has set OMP_WAIT_POLICY or GOMP_SPINCOUNT, as the program that it starts finds them. To be
/// called first in main.
///
/// Why: by default GCC's OpenMP spins for about a millisecond. A run that shares its cores with another process then
/// takes several times its time: North America with 2e4 points 3.5 times (median of five pairs). OpenMP reads the
/// variables when it is loaded, before main, and has no call to change them.
void shorten_waits(char** argv);

} // namespace trime::app
