// SPDX-License-Identifier: BSD-3-Clause
// Size fields as the config wants them.
#include "app/size_builder.hpp"

#include "app/config.hpp"
#include "app/shape_builder.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trime::app {
namespace {

const std::string plate = "[shape]\nregion = plate\n[shape.plate]\ntype = rectangle\nx_min = 0.1\nx_max = 0.9\n"
                          "y_min = 0.3\ny_max = 0.7\n[meshing]\npoints = 1000\n";

/// The size field of the plate with some overrides.
struct Built {
  explicit Built(const std::vector<std::string>& overrides)
      : options(parse_config(plate, "c.ini", overrides)), log(LogLevel::silent, false),
        domain(read_shape(options, ShapeUse::boundary, comm, log, places).domain()),
        size(build_size(options, domain, comm)) {}

  double at(double x, double y) const { return size.field->size({x, y}); }

  comm::Communicator comm = comm::Communicator::world();
  RunOptions options;
  Log log;
  UserPlaces places;
  geometry::Domain domain;
  BuiltSize size;
};

TEST(SizeBuilder, TheFeatureFloorIsHalfAnEdge) {
  meshing::MeshOptions mesh;
  mesh.edge_length = 0.1;
  EXPECT_EQ(feature_floor(mesh, 1), 0.05);
  mesh.edge_length.reset();
  mesh.points = 1000000;
  const double edge = 2 * feature_floor(mesh, 1); // two equilateral triangles for each point
  EXPECT_NEAR(2 * 1e6 * std::sqrt(3.0) / 4 * edge * edge, 1, 1e-12);
}

TEST(SizeBuilder, MakesEachType) {
  const Built uniform({});
  EXPECT_TRUE(uniform.size.field->is_uniform());
  EXPECT_EQ(uniform.size.description, "uniform");
  const Built formula({"sizing.type=expression", "sizing.expression=1+3*x+3*y", "sizing.max_size=0.5"});
  EXPECT_EQ(formula.at(0.25, 0.5), 3.25);
  EXPECT_EQ(formula.size.description, "expression 1+3*x+3*y, at most 0.5");
  const Built automatic({"sizing.type=automatic", "sizing.gradation=0.2"});
  EXPECT_GT(automatic.at(0.5, 0.5), 2 * automatic.at(0.1, 0.3)) << "small in the corners, large on the axis";
  EXPECT_TRUE(Built({"sizing.type=automatic", "sizing.gradation=0"}).size.field->is_uniform());
}

TEST(SizeBuilder, PlacesAFormulaThatIsNotPositive) {
  try {
    const Built built({"sizing.type=expression", "sizing.expression=x-0.5"});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_EQ(std::string(error.what()).find("command line: 'expression' in [sizing]: "), 0u) << error.what();
  }
}

} // namespace
} // namespace trime::app
