// SPDX-License-Identifier: BSD-3-Clause
// The curves on which sites are laid out: the loops of the boundary, and the curves inside the shape.
#pragma once

#include "trime/geometry/boundary.hpp"

#include <optional>
#include <span>

namespace trime::boundary {

/// @brief The boundary of a shape together with its inner curves, all of them as loops: first those of the boundary,
/// then one for each arc. An open arc becomes a loop that leads there and back, see geometry::Loop::turning. Keeps a
/// reference to the curves inside, and to the boundary if there are no curves inside; otherwise it holds a copy of it.
class LaidCurves {
public:
  /// @param corners vertices of the inner curves that the mesh keeps, in lexicographic order
  LaidCurves(const geometry::Boundary& boundary, const geometry::InnerCurves& inner,
             std::span<const geometry::Vec2> corners = {});

  /// Returns the boundary as it was given.
  const geometry::Boundary& boundary() const { return boundary_; }
  /// Returns all loops. Use this value only as a list of curves: it bounds no shape if there are inner curves.
  const geometry::Boundary& all() const { return joined_ ? *joined_ : boundary_; }
  /// Returns the number of loops of the boundary, which come first.
  std::size_t boundary_loops() const { return boundary_.loops.size(); }
  /// Return what geometry::InnerCurves holds.
  std::int64_t joined_nodes() const { return inner_.joined_nodes; }
  const std::vector<geometry::RegionLoss>& losses() const { return inner_.losses; }
  /// Returns an arc inside.
  const geometry::InnerArc& arc(std::size_t number) const { return inner_.arcs[number]; }

private:
  const geometry::Boundary& boundary_;
  const geometry::InnerCurves& inner_;
  std::optional<geometry::Boundary> joined_;
};

} // namespace trime::boundary
