// SPDX-License-Identifier: BSD-3-Clause
// A custom size field: elements of relative size 1 + 3 x + 3 y in the rectangle [0.1, 0.9] x [0.3, 0.7]. mpirun -np 2
// graded_rectangle [POINTS [DIRECTORY]]
#include <trime/comm/communicator.hpp>
#include <trime/core/error.hpp>
#include <trime/io/describe.hpp>
#include <trime/io/mesh_file.hpp>
#include <trime/meshing/make_mesh.hpp>
#include <trime/shape/region_shape.hpp>
#include <trime/sizing/size_field.hpp>

#include <cstdio>
#include <cstdlib>

namespace geometry = trime::geometry;

/// Only ratios count: the mesher scales the field so that the number of points comes out.
class Graded final : public trime::sizing::SizeField {
public:
  double size(geometry::Vec2 p) const override { return 1 + 3 * p.x + 3 * p.y; }
};

int main(int argc, char** argv) {
  const trime::comm::Environment mpi(argc, argv);
  const trime::comm::Communicator comm = trime::comm::Communicator::world();
  try {
    trime::io::MeshFileOptions file;
    file.directory = argc > 2 ? argv[2] : "out";
    file.name = "graded_rectangle";
    file.overwrite = true;
    trime::io::check_output(file, comm); // before the work: makes the directory, or says why it cannot

    trime::meshing::MeshOptions options;
    options.points = argc > 1 ? std::atoll(argv[1]) : 5000;
    const geometry::Frame frame(geometry::unit_square); // the container
    // Parts are joined by name; with more of them the region could be "difference(plate, union(hole, slot))".
    const trime::shape::RegionShape shape({trime::shape::Part::rectangle("plate", {{0.1, 0.3}, {0.9, 0.7}}, frame)},
                                          "plate", frame);
    trime::Log log(trime::LogLevel::warning, comm.is_root());
    const trime::meshing::MeshResult result = trime::meshing::make_mesh(comm, shape, Graded(), options, log);

    trime::io::write_mesh(file, result.mesh, trime::io::describe(result.mesh, result.quality, result.checks), comm);

    if (comm.is_root())
      std::printf("%lld points, %lld triangles; median alpha %.4f, max alpha %.4f; edge length over wanted length "
                  "%.3f +- %.3f; hash %016llx\n",
                  static_cast<long long>(result.mesh.point_slab.total),
                  static_cast<long long>(result.mesh.triangle_slab.total), result.quality.alpha.median,
                  result.quality.alpha.max, result.quality.size_mean, result.quality.size_std,
                  static_cast<unsigned long long>(result.mesh.hash));
    return is_complete(result) ? 0 : 5;
  } catch (const trime::Error& error) { // all ranks have the same one
    if (comm.is_root())
      std::fprintf(stderr, "graded_rectangle: error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
