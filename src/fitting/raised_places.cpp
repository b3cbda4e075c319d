// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/raised_places.hpp"

#include "fitting/rules.hpp"

#include <cmath>

namespace trime::fitting {

std::vector<sizing::LeastSize> raised_around(std::span<const geometry::ShortEdge> edges, const sites::Stage& stage,
                                             const FitOptions& options, int round) {
  std::vector<sizing::LeastSize> places;
  if (options.features.keep_all)
    return places;
  const double step = round < RaisingRules::small_steps ? RaisingRules::first_step : RaisingRules::last_step;
  for (const geometry::ShortEdge& edge : edges) {
    const double h = sizing::checked_size(stage.asked_size(), edge.middle);
    const double most = std::fmin(RaisingRules::most_raised * stage.growing_size().size(edge.middle),
                                  options.max_size.value_or(INFINITY));
    if (const double raised = std::fmin(step * h, most); raised > RaisingRules::least_raise * h)
      places.push_back({edge.middle, raised});
  }
  return places;
}

} // namespace trime::fitting
