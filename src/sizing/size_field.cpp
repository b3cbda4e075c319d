// SPDX-License-Identifier: BSD-3-Clause
#include "trime/sizing/size_field.hpp"

#include "trime/core/error.hpp"

namespace trime::sizing {

void fail_for_size(geometry::Vec2 p, double size) {
  throw GeometryError(fmt::format("the size field at {}: expected a positive finite size, found {}; the field "
                                  "must be positive in the whole shape",
                                  Place(p, 0), size));
}

} // namespace trime::sizing
