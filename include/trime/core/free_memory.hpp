// SPDX-License-Identifier: BSD-3-Clause
// Memory that was freed, back to the system: the C library keeps pieces of up to 32 MB for later.
#pragma once

namespace trime {

/// @brief Returns freed memory, for the end of a stage whose arrays the next does not need. A few ms; does nothing
/// where the C library has no such call.
void return_free_memory();

} // namespace trime
