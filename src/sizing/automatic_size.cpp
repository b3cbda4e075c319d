// SPDX-License-Identifier: BSD-3-Clause
#include "trime/sizing/automatic_size.hpp"

#include "trime/core/error.hpp"

#include <cmath>

namespace trime::sizing {

std::unique_ptr<SizeField> make_automatic_size(const comm::Communicator&, const geometry::Boundary& boundary,
                                               const AutomaticSizeOptions& options) {
  if (!(options.gradation >= 0) || !std::isfinite(options.gradation))
    throw ConfigError(fmt::format("expected a gradation of at least 0, found {}", options.gradation));
  if (options.gradation == 0 || boundary.loops.empty())
    return std::make_unique<UniformSize>();
  throw ConfigError("automatic sizes with a gradation above 0 are not available yet; take gradation = 0");
}

} // namespace trime::sizing
