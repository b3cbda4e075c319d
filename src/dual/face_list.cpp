// SPDX-License-Identifier: BSD-3-Clause
#include "dual/face_list.hpp"

#include <algorithm>
#include <cmath>

namespace trime::dual {

using geometry::Vec2;

void FaceList::add(LocalIndex site, const Surroundings& around, const SeenVertices& seen) {
  for (std::size_t spoke = 0; spoke < around.arms.size(); ++spoke) {
    const LocalIndex end = around.ends[spoke];
    made_.neighbours.push_back(end);
    if (cells_.number_of(site) < cells_.number_of(end))
      made_.neighbour_faces.push_back(append(face_at(site, spoke, around, seen)));
    else if (end < cells_.site_count)
      made_.neighbour_faces.push_back(known_face(end, site));
    else {
      waiting_.push_back({face_at(site, spoke, around, seen), made_.neighbour_faces.size()});
      made_.neighbour_faces.push_back(-1);
    }
  }
  made_.neighbour_first.push_back(std::ssize(made_.neighbours));
}

void FaceList::add_those_of_others() {
  made_.owned_faces = static_cast<LocalIndex>(made_.faces.size());
  for (const Waiting& waiting : waiting_)
    made_.neighbour_faces[waiting.row] = append(waiting.face);
}

/// Makes a face with the lower of its two cells first.
FaceList::Face FaceList::face_at(LocalIndex site, std::size_t spoke, const Surroundings& around,
                                 const SeenVertices& seen) const {
  const auto vertex = [&](std::optional<std::size_t> triangle) {
    return triangle ? seen.centres[*triangle] : seen.middles[spoke];
  };
  Face face{{site, around.ends[spoke]},
            {vertex(around.right(spoke)), vertex(around.left(spoke))},
            around.arms[spoke],
            {},
            {}};
  if (cells_.number_of(face.cells[1]) < cells_.number_of(site)) {
    std::swap(face.cells[0], face.cells[1]);
    std::swap(face.vertices[0], face.vertices[1]);
    face.arm = Vec2{0, 0} - face.arm;
  }
  set_lengths(around, spoke, face);
  return face;
}

/// Sets the lengths of a face by its region, the one on the left of the arm first. They are computed from the corner
/// opposite to the edge, so that both ends find the same bits.
void FaceList::set_lengths(const Surroundings& around, std::size_t spoke, Face& face) const {
  std::array sides{around.left(spoke), around.right(spoke)};
  if (face.cells[1] != around.ends[spoke])
    std::swap(sides[0], sides[1]);
  std::size_t parts = 0;
  for (const std::optional<std::size_t>& side : sides) {
    if (!side)
      continue;
    const CellTriangle& triangle = cells_.triangles[at(around.triangles[*side])];
    LocalIndex apex = triangle.corners[0];
    for (const LocalIndex corner : triangle.corners)
      if (corner != face.cells[0] && corner != face.cells[1])
        apex = corner;
    const auto arm = [&](LocalIndex end) {
      return difference(cells_.points[at(end)], cells_.points[at(apex)], cells_.period);
    };
    const Vec2 a = arm(face.cells[0]), b = arm(face.cells[1]);
    const double half = 0.5 * length(face.arm) * dot(a, b) / std::fabs(cross(a, b));
    if (parts == 1 && face.regions[0] == triangle.region) {
      face.lengths[0] += half;
      continue;
    }
    face.regions[parts] = triangle.region;
    face.lengths[parts++] = half;
  }
}

LocalIndex FaceList::append(const Face& face) {
  made_.faces.push_back(face.cells);
  made_.face_vertices.push_back(face.vertices);
  made_.face_arms.push_back(face.arm);
  made_.face_lengths.push_back(face.lengths);
  made_.face_regions.push_back(face.regions);
  return static_cast<LocalIndex>(made_.faces.size()) - 1;
}

/// Returns the face of a site before with a neighbour.
LocalIndex FaceList::known_face(LocalIndex site, LocalIndex neighbour) const {
  const auto row = [&](std::size_t k) {
    return made_.neighbours.begin() + static_cast<std::ptrdiff_t>(made_.neighbour_first[k]);
  };
  const auto found = std::find(row(at(site)), row(at(site) + 1), neighbour);
  return made_.neighbour_faces[static_cast<std::size_t>(found - made_.neighbours.begin())];
}

} // namespace trime::dual
