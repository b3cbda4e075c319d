// SPDX-License-Identifier: BSD-3-Clause
// Functions that several fuzz targets use. A target passes arbitrary bytes to the program. The program may throw only
// the errors that it documents; anything else ends the process, and libFuzzer saves the bytes.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trime::fuzz {

/// Runs `work`, which may throw the errors that a mistake of a user causes.
/// @return whether it ended without an error
template <class Work>
bool survives(const Work& work) {
  try {
    work();
    return true;
  } catch (const ConfigError& error) {
    TRIME_ASSERT(*error.what() != '\0', "an error without a word");
  } catch (const GeometryError& error) {
    TRIME_ASSERT(*error.what() != '\0', "an error without a word");
  } catch (const FileError& error) {
    TRIME_ASSERT(*error.what() != '\0', "an error without a word");
  }
  return false;
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// @brief Uses a contour in the same way as the program: sends it to other ranks, fits it into a container and makes a
/// shape of it, in a plain and in a periodic container. Contours with many vertices are only sent, because the fuzzer
/// should try many small ones; other tests use large contours.
void use(const contours::Contour& contour);

/// Uses the lines of curves in the same way: as curves inside a square, clipped to it and not.
void use_curves(const contours::Contour& contour);

} // namespace trime::fuzz
