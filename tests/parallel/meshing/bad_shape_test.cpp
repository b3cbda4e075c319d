// SPDX-License-Identifier: BSD-3-Clause
// Shapes of a user's own that fail on one rank alone: an error on all ranks together, and no rank is left waiting.
#include "trime/core/error.hpp"
#include "trime/core/log.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/sizing/size_field.hpp"
#include "trime/tracing/shape.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

namespace trime::meshing {
namespace {

using geometry::Vec2;

/// A disc; at the n-th call `fail` decides on the value, or throws.
class FailingDisc final : public tracing::Shape {
public:
  FailingDisc(int call, std::function<double()> fail) : call_(call), fail_(std::move(fail)) {}
  double signed_distance(Vec2 p) const override {
    return ++calls_ == call_ ? fail_() : geometry::length(p - Vec2{0.5, 0.5}) - 0.3;
  }
  int calls() const { return calls_; }

private:
  int call_;
  std::function<double()> fail_;
  mutable std::atomic<int> calls_{0};
};

constexpr int never = 0;
const std::function<double()> fine = [] { return 0.0; };

MeshOptions small() {
  MeshOptions options;
  options.points = 200;
  options.method = sweep::Method::distmesh;
  options.max_sweeps = 2;
  return options;
}

MeshResult run(const comm::Communicator& comm, const tracing::Shape& shape) {
  Log log(LogLevel::silent, false);
  return make_mesh(comm, traced_domain(comm, shape, geometry::Frame(geometry::unit_square)), sizing::UniformSize(),
                   small(), log);
}

/// How often a disc that never fails is asked.
int calls_of_a_run(const comm::Communicator& comm) {
  const FailingDisc disc(never, fine);
  EXPECT_GT(run(comm, disc).mesh.point_slab.total, 100);
  return disc.calls();
}

/// The message of an error of this class on every rank, of a shape that fails on one rank alone.
template <class Expected>
std::string error_of(const comm::Communicator& comm, int rank, int call, const std::function<double()>& fail) {
  const FailingDisc disc(comm.rank() == rank ? call : never, fail);
  std::string message;
  try {
    run(comm, disc);
  } catch (const Expected& error) {
    message = error.what();
  }
  comm.barrier(); // nobody is left behind in a collective
  return message;
}

TEST(BadShape, AnExceptionOnOneRankEndsAll) {
  const comm::Communicator world = comm::Communicator::world();
  const int calls = calls_of_a_run(world);
  ASSERT_GT(calls, 10000);
  for (const int rank : {0, world.size() - 1})
    for (const int call : {1, 1000, calls / 2, calls}) // while cells are sought, and while chords are refined
      EXPECT_NE(
          error_of<InternalError>(world, rank, call, []() -> double { throw std::runtime_error("no shape today"); })
              .find("no shape today"),
          std::string::npos)
          << "rank " << rank << ", call " << call;
  EXPECT_EQ(calls_of_a_run(world), calls); // a run after that is as any other
}

TEST(BadShape, TheErrorKeepsItsClass) {
  const comm::Communicator world = comm::Communicator::world();
  const int last = world.size() - 1;
  EXPECT_NE(error_of<FileError>(world, last, 500, []() -> double { throw FileError("no map"); }).find("no map"),
            std::string::npos);
  EXPECT_NE(error_of<GeometryError>(world, last, 500, [] { return std::numeric_limits<double>::quiet_NaN(); })
                .find("expected a finite value everywhere in the container, found NaN"),
            std::string::npos);
  EXPECT_NE(error_of<InternalError>(world, last, 500,
                                    []() -> double {
                                      throw 42; // NOLINT(hicpp-exception-baseclass)
                                    })
                .find("not a std::exception"),
            std::string::npos);
  try {
    run(world, FailingDisc(world.rank() == last ? 500 : never, []() -> double { throw std::bad_alloc(); }));
    ADD_FAILURE() << "no error was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::out_of_memory);
  }
  world.barrier();
}

/// One that has another shape on one rank: not an exception, but a mesh of two shapes at once.
TEST(BadShape, AnotherValueOnOneRankIsFound) {
  const comm::Communicator world = comm::Communicator::world();
  if (world.size() == 1)
    GTEST_SKIP() << "one rank";
  class Moved final : public tracing::Shape {
  public:
    explicit Moved(double by) : by_(by) {}
    double signed_distance(Vec2 p) const override { return geometry::length(p - Vec2{0.5 + by_, 0.5}) - 0.3; }

  private:
    double by_;
  };
  EXPECT_THROW(run(world, Moved(world.is_root() ? 0x1p-20 : 0)), InternalError);
  world.barrier();
}

} // namespace
} // namespace trime::meshing
