// SPDX-License-Identifier: BSD-3-Clause
// How the program gets memory for its large arrays; see large_arrays.cpp.
#pragma once

namespace trime::app {

/// To be called once, before anything large is made.
void prepare_large_arrays();

} // namespace trime::app
