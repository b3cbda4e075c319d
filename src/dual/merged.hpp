// SPDX-License-Identifier: BSD-3-Clause
// Merges the vertices of Voronoi cells that lie at one place: circumcentres of triangles on one circle, as in lattices
// and at right angles. Some programs do not accept cells with edges of length 0.
#pragma once

#include "dual/vertices.hpp"

#include <vector>

namespace trime::dual {

/// @brief Finds for each vertex of whole cells the vertex with the lowest number at its place. Vertices of one cell
/// that follow each other are at one place if their distance is at most 1e-9 of the edge of the mesh between them, and
/// so are vertices that are joined by a chain of such pairs. All cells with such a vertex use the same number.
class MergedVertices {
public:
  /// @pre cells and vertices outlive this object
  /// @note Collective; a few sparse exchanges.
  MergedVertices(const Cells& cells, const CellVertices& vertices, const comm::Communicator& comm);

  /// Returns the corners of a whole cell without repeated ones, counter-clockwise.
  std::vector<CellCorner> corners(const Surroundings& around, LocalIndex site, const CellPart& cell) const;

private:
  struct Pair {
    LocalIndex first, second; // triangles
  };
  struct Known;

  void find_pairs();
  bool join_pairs();
  void share(const comm::Communicator& comm);

  const Cells& cells_;
  const CellVertices& vertices_;
  std::vector<Pair> pairs_;
  std::vector<GlobalId> lowest_; // by triangle of this rank
};

} // namespace trime::dual
