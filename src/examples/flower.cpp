// SPDX-License-Identifier: BSD-3-Clause
// A custom shape: a six-pointed star with a round hole, given by a signed distance, meshed and written by all ranks.
// mpirun -np 2 flower [POINTS [DIRECTORY]]
#include <trime/comm/communicator.hpp>
#include <trime/core/error.hpp>
#include <trime/io/describe.hpp>
#include <trime/io/mesh_file.hpp>
#include <trime/meshing/make_mesh.hpp>
#include <trime/sizing/size_field.hpp>
#include <trime/tracing/shape.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace geometry = trime::geometry;
using geometry::Vec2;

/// Two equilateral triangles, one turned by 180 degrees, around (0.5, 0.5); their sides are 0.2 from the centre.
class Flower final : public trime::tracing::Shape {
public:
  double signed_distance(Vec2 p) const override {
    const double to_center = geometry::length(p - center);
    return std::max(star(p - center), hole_radius - to_center); // inside the star, but not in the hole
  }

private:
  static constexpr Vec2 center{0.5, 0.5};
  static constexpr double inradius = 0.2, hole_radius = 0.1;

  /// The star has twelve mirrors. Reflecting a point into the sector above the x axis that lies between two of them
  /// leaves one side to look at: y = inradius, from the concave corner at inradius/sqrt(3) to the tip.
  static double star(Vec2 p) {
    const double root = std::sqrt(3.0);
    p = {std::abs(p.x), std::abs(p.y)};
    for (const Vec2 normal : {Vec2{-0.5, root / 2}, Vec2{root / 2, -0.5}})
      p = p - 2 * std::min(dot(p, normal), 0.0) * normal;
    const Vec2 nearest{std::clamp(p.x, inradius / root, inradius * root), inradius};
    return std::copysign(length(p - nearest), p.y - nearest.y);
  }
};

int main(int argc, char** argv) {
  const trime::comm::Environment mpi(argc, argv);
  const trime::comm::Communicator comm = trime::comm::Communicator::world();
  try {
    trime::io::MeshFileOptions file;
    file.directory = argc > 2 ? argv[2] : "out";
    file.name = "flower";
    file.overwrite = true;
    trime::io::check_output(file, comm); // before the work: makes the directory, or says why it cannot

    const geometry::Frame frame(geometry::unit_square); // the container in which the shape is traced
    const geometry::Domain domain = trime::meshing::traced_domain(comm, Flower(), frame);
    trime::meshing::MeshOptions options;
    options.points = argc > 1 ? std::atoll(argv[1]) : 5000;
    trime::Log log(trime::LogLevel::warning, comm.is_root());
    const trime::meshing::MeshResult result =
        trime::meshing::make_mesh(comm, domain, trime::sizing::UniformSize(), options, log);

    trime::io::write_mesh(file, result.mesh, trime::io::describe(result.mesh, result.quality, result.checks), comm);

    if (comm.is_root())
      std::printf("%lld points, %lld triangles, %lld corners; median alpha %.4f, max alpha %.4f; hash %016llx\n",
                  static_cast<long long>(result.mesh.point_slab.total),
                  static_cast<long long>(result.mesh.triangle_slab.total), static_cast<long long>(result.corners),
                  result.quality.alpha.median, result.quality.alpha.max,
                  static_cast<unsigned long long>(result.mesh.hash));
    return is_complete(result) ? 0 : 5;
  } catch (const trime::Error& error) { // all ranks have the same one
    if (comm.is_root())
      std::fprintf(stderr, "flower: error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
