// SPDX-License-Identifier: BSD-3-Clause
// What the fuzz targets share. A target hands foreign bytes to the program; only the errors that the program documents
// may come out. Anything else ends the process, and libFuzzer keeps the bytes.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trime::fuzz {

/// Runs `work`, which may throw what a user's mistake causes. @return did it go through?
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

/// @brief What the program does with a contour that was read: it is sent to other ranks, fitted into a container and
/// becomes a shape, in a plain and in a periodic container. Contours of many vertices are only sent: the tests of
/// shapes have larger ones, and here many small ones are tried.
void use(const contours::Contour& contour);

} // namespace trime::fuzz
