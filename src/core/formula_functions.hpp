// SPDX-License-Identifier: BSD-3-Clause
// The functions that formulas may call. Their bits do not depend on the machine; they replace those of muParser.
#pragma once

#include <muParser.h>

#include <string>

namespace trime {

/// @brief Replaces all functions of the parser and its power by ours, and has it compute what is written: muParser
/// would turn a x + b x into (a + b) x, and its library may fuse products and sums on some processors.
void define_functions(mu::Parser& parser);

/// @brief The text as the parser must see it, as long as before: muParser's own `^` cannot be replaced, so ours has
/// another sign there.
std::string with_our_power(std::string text);

/// @brief Takes that back, for messages.
std::string with_usual_power(std::string text);

} // namespace trime
