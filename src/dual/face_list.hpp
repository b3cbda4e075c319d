// SPDX-License-Identifier: BSD-3-Clause
// Lists the faces between the cells of one rank and their neighbours, each once, and the neighbours of each cell.
#pragma once

#include "dual/site_cell.hpp"
#include "trime/dual/local_cells.hpp"

#include <vector>

namespace trime::dual {

/// The vertices around a site, as indices into LocalCells::vertices.
struct SeenVertices {
  std::vector<LocalIndex> centres; ///< by triangle of Surroundings
  std::vector<LocalIndex> middles; ///< by spoke; -1 where the cell is not divided
  LocalIndex site = -1;            ///< the site itself; -1 if the cell is not divided
};

class FaceList {
public:
  /// @pre cells and made outlive this object
  FaceList(const Cells& cells, LocalCells& made) : cells_(cells), made_(made) {}

  /// Adds the neighbours of a site, and the faces whose first cell is that of the site. Sites come in ascending order.
  void add(LocalIndex site, const Surroundings& around, const SeenVertices& seen);
  /// Adds the faces whose first cell belongs to another rank. Comes last.
  void add_those_of_others();

private:
  struct Face {
    std::array<LocalIndex, 2> cells, vertices;
    geometry::Vec2 arm;
    std::array<double, 2> lengths;
    std::array<std::int32_t, 2> regions;
  };
  /// A face of another rank, and its place in neighbour_faces.
  struct Waiting {
    Face face;
    std::size_t row;
  };

  Face face_at(LocalIndex site, std::size_t spoke, const Surroundings& around, const SeenVertices& seen) const;
  void set_lengths(const Surroundings& around, std::size_t spoke, Face& face) const;
  LocalIndex append(const Face& face);
  LocalIndex known_face(LocalIndex site, LocalIndex neighbour) const;

  const Cells& cells_;
  LocalCells& made_;
  std::vector<Waiting> waiting_;
};

} // namespace trime::dual
