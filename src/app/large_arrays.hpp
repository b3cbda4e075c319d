// SPDX-License-Identifier: BSD-3-Clause
// Sets how the program allocates memory for its large arrays; large_arrays.cpp explains how.
#pragma once

namespace trime::app {

/// Must be called once, before any large array is allocated.
void prepare_large_arrays();

} // namespace trime::app
