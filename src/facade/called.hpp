// SPDX-License-Identifier: BSD-3-Clause
// Calls functions that a user gave.
#pragma once

#include "trime/core/error.hpp"
#include "trime/geometry/vec2.hpp"

#include <exception>
#include <functional>
#include <string>

namespace trime {

/// @brief Returns the value of the user's function at p. @param what names the function in messages
/// @throws GeometryError on this rank alone, with the place, if the function throws anything other than an Error
inline double called(const std::function<double(geometry::Vec2)>& function, geometry::Vec2 p, const std::string& what) {
  try {
    return function(p);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw GeometryError(fmt::format("{} failed at ({:.9g}, {:.9g}): {}", what, p.x, p.y, error.what()));
  } catch (...) {
    throw GeometryError(fmt::format("{} failed at ({:.9g}, {:.9g}): it threw an exception that is not a std::exception",
                                    what, p.x, p.y));
  }
}

} // namespace trime
