// SPDX-License-Identifier: BSD-3-Clause
// Reads a mesh file and checks its triangles against CGAL's Delaunay triangulation of its points, for a convex shape:
// the circumdisc of each triangle of either is empty, and without cocircular points the triangles are the same.
// Usage: cgal_confirms FILE.h5. Prints what it counted; exit code 0 if CGAL confirms the mesh.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int64_t, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
using Triangle = std::array<std::int64_t, 3>;

/// All values of a two-dimensional dataset, row by row.
template <class T>
std::vector<T> read(hid_t file, const char* name, hid_t type) {
  const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
  hsize_t extent[2] = {0, 0};
  H5Sget_simple_extent_dims(space, extent, nullptr);
  std::vector<T> values(extent[0] * extent[1]);
  H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(dataset);
  return values;
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2)
    return 2;
  const hid_t file = H5Fopen(argv[1], H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0)
    return 2;
  const std::vector<double> xy = read<double>(file, "/Mesh/mesh/geometry", H5T_NATIVE_DOUBLE);
  const std::vector<std::int64_t> ids = read<std::int64_t>(file, "/Mesh/mesh/topology", H5T_NATIVE_INT64);
  H5Fclose(file);

  std::vector<std::pair<Kernel::Point_2, std::int64_t>> points;
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
    points.emplace_back(Kernel::Point_2(xy[2 * i], xy[2 * i + 1]), static_cast<std::int64_t>(i));
  const Delaunay delaunay(points.begin(), points.end());

  std::set<Triangle> of_mesh;
  std::size_t clockwise = 0;
  for (std::size_t t = 0; t < ids.size(); t += 3) {
    of_mesh.insert(sorted({ids[t], ids[t + 1], ids[t + 2]}));
    const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(ids[t + k])].first; };
    clockwise += CGAL::orientation(at(0), at(1), at(2)) != CGAL::LEFT_TURN;
  }
  std::size_t missing = 0, unexplained = 0;
  for (const auto face : delaunay.finite_face_handles()) {
    const Triangle t = sorted({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    if (of_mesh.count(t) > 0)
      continue;
    ++missing; // allowed only where a fourth point lies on the same circle, so that the diagonal is free
    bool cocircular = false;
    for (int k = 0; k < 3; ++k) {
      const auto neighbour = face->neighbor(k);
      cocircular |= !delaunay.is_infinite(neighbour) &&
                    delaunay.side_of_oriented_circle(face, delaunay.mirror_vertex(face, k)->point()) ==
                        CGAL::ON_ORIENTED_BOUNDARY;
    }
    unexplained += !cocircular;
  }
  fmt::print("{} points, {} triangles, {} of CGAL; {} clockwise, {} differ, {} of them not cocircular\n", points.size(),
             of_mesh.size(), delaunay.number_of_faces(), clockwise, missing, unexplained);
  const bool confirmed = points.size() == delaunay.number_of_vertices() && 3 * of_mesh.size() == ids.size() &&
                         of_mesh.size() == delaunay.number_of_faces() && clockwise == 0 && unexplained == 0;
  return confirmed ? 0 : 1;
}
