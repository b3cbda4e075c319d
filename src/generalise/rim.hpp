// SPDX-License-Identifier: BSD-3-Clause
// Walks along the border between the inside and the outside of a triangulation.
#pragma once

#include "generalise/triangulation.hpp"

#include <vector>

namespace trime::generalise {

/// The half-edges with the inside on their left and the outside on their right. Keeps references to both arguments.
class Rim {
public:
  using HalfEdge = Triangulation::HalfEdge;

  /// @param labels 1 for each triangle that lies inside
  Rim(const Triangulation& mesh, const std::vector<char>& labels) : mesh_(mesh), labels_(labels) {}

  bool is_inside(HalfEdge e) const { return e != Triangulation::none && labels_[at(Triangulation::triangle(e))] != 0; }
  bool holds(HalfEdge e) const { return is_inside(e) && !is_inside(mesh_.twin(e)); }
  /// Returns the next half-edge along the border of the same part of the inside.
  /// @pre holds(e)
  HalfEdge next(HalfEdge e) const {
    HalfEdge f = Triangulation::next(e);
    while (!holds(f))
      f = Triangulation::next(mesh_.twin(f));
    return f;
  }
  /// Returns the half-edge before e along the border.
  /// @pre holds(e)
  HalfEdge previous(HalfEdge e) const {
    HalfEdge f = Triangulation::previous(e);
    while (!holds(f))
      f = Triangulation::previous(mesh_.twin(f));
    return f;
  }

private:
  const Triangulation& mesh_;
  const std::vector<char>& labels_;
};

} // namespace trime::generalise
