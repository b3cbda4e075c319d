// SPDX-License-Identifier: BSD-3-Clause
// A list that many threads make, in the order in which one would make it.
#pragma once

#include "core/gather.hpp"
