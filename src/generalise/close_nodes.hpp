// SPDX-License-Identifier: BSD-3-Clause
// Joins the nodes of curves and interfaces that lie nearer to each other than the triangles can show.
#pragma once

#include "generalise/vertex_tree.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/sizing/size_field.hpp"

#include <map>
#include <span>
#include <utility>

namespace trime::generalise {

/// Vertices of a tree, by place.
using VerticesByPlace = std::map<std::pair<double, double>, LocalIndex>;

/// The nodes at the ends of open arcs.
struct Nodes {
  VerticesByPlace vertices{};
  LocalIndex rim_vertices = 0;            ///< vertices below this number lie on the boundary
  std::span<const geometry::Vec2> kept{}; ///< places that must stay, in lexicographic order
};

/// @brief Removes arcs that are one edge shorter than GeneraliseRules::node_distance, and moves all other arcs at one
/// of its ends to the other end. An end stays if it lies on the boundary, if it is one of Nodes::kept, or if fewer than
/// three arcs meet there. Two arcs that become the same edge become one arc, which separates what lies beyond both of
/// them; it keeps its own curve if it has one. They stay two if they separate two regions that were not neighbours
/// before. Free ends of curves stay, too, and so does the last edge of a curve. Arcs do not cross each other
/// afterwards: the triangle over which an edge moves holds no vertex. Where two regions touched along the edge, the
/// other regions around it touch in the node. Adds to InnerCurves::joined_nodes and losses.
/// Cost: O(n log n) for n arcs.
void join_close_nodes(geometry::InnerCurves& curves, const Nodes& nodes, const sizing::SizeField& size,
                      VertexTree& tree);

} // namespace trime::generalise
