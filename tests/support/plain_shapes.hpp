// SPDX-License-Identifier: BSD-3-Clause
// Makes shapes in the unit square and meshes of them without output, for tests of whole meshes.
#pragma once

#include "trime/meshing/mesher.hpp"
#include "trime/shape/region_shape.hpp"
#include "trime/sizing/size_field.hpp"

#include <gtest/gtest.h>

namespace trime::testing {

inline const geometry::Frame& unit_frame() {
  static const geometry::Frame frame(geometry::Box{{0, 0}, {1, 1}});
  return frame;
}

inline shape::RegionShape whole_container() {
  return {{}, "domain", unit_frame()};
}
/// Returns a square with side 0.8 in the middle of the unit square.
inline shape::RegionShape square() {
  return {{shape::Part::rectangle("s", {{0.1, 0.1}, {0.9, 0.9}}, unit_frame())}, "s", unit_frame()};
}
inline shape::RegionShape triangle(geometry::Vec2 a = {0.1, 0.1}, geometry::Vec2 b = {0.9, 0.2},
                                   geometry::Vec2 c = {0.4, 0.8}) {
  return {{shape::Part::triangle("t", {a, b, c}, unit_frame())}, "t", unit_frame()};
}
/// Returns a disc with radius 0.4 in the middle of the unit square.
inline shape::RegionShape disc() {
  return {{shape::Part::circle("d", {0.5, 0.5}, 0.4, unit_frame())}, "d", unit_frame()};
}
/// Returns the disc without a smaller disc.
inline shape::RegionShape disc_with_hole(geometry::Vec2 center = {0.55, 0.5}, double radius = 0.15) {
  return {
      {shape::Part::circle("d", {0.5, 0.5}, 0.4, unit_frame()), shape::Part::circle("h", center, radius, unit_frame())},
      "difference(d, h)",
      unit_frame()};
}

inline meshing::MeshResult mesh_silently(const comm::Communicator& comm, const geometry::Domain& domain,
                                         const sizing::SizeField& size, const meshing::MeshOptions& options,
                                         const meshing::SnapshotObserver& observer = {}) {
  Log log(LogLevel::silent, false);
  TimerTable timers;
  meshing::Mesher mesher(comm, domain, size, options, log, timers);
  mesher.on_snapshot(observer);
  return mesher.run();
}

inline void expect_certified(const meshing::MeshResult& result) {
  for (const mesh::Check& check : result.checks)
    EXPECT_TRUE(check.passed) << check.name << ": expected " << check.expected << ", found " << check.found;
}

} // namespace trime::testing
