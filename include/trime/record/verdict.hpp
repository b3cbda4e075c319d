// SPDX-License-Identifier: BSD-3-Clause
// Results about a mesh, as its file lists them: how well it obeys each rule of a model, and how many points each of
// several sizes decides. Plain data.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <optional>
#include <string>

namespace trime::record {

/// Says how well a mesh obeys one rule of a model of coasts or oceans.
struct Verdict {
  std::string solver;                  ///< the model: "adcirc", "schism", "telemac", "fvcom", "delft3d", "mpas"
  std::string rule;                    ///< what the rule limits, such as "least_angle"; see configs/formats.md
  bool is_least = false;               ///< the limit is the smallest allowed value; otherwise the largest one
  double limit = 0;                    ///< [degrees], [1] or a count, as the rule says
  double worst = 0;                    ///< the worst value in the mesh; the limit if there was nothing to measure
  GlobalId broken = 0;                 ///< number of triangles, points or pairs that break the rule
  GlobalId measured = 0;               ///< number of those that were measured
  bool refuses = false;                ///< the model stops, or computes on another mesh, where the rule is broken
  std::optional<geometry::Vec2> place; ///< place of the worst value; empty for rules about the whole mesh

  bool holds() const { return broken == 0; }
};

/// The number of points at which one of several sizes is the smallest one.
struct SizeShare {
  std::string name; ///< the section of a config with the size: "size.wave", or "sizing"; or what lowers all of them:
                    ///< "regions" or "size_at"
  GlobalId points = 0;
};

} // namespace trime::record
