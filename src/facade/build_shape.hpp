// SPDX-License-Identifier: BSD-3-Clause
// Makes the boundary, on every rank, from the shape that a program gave. A Shape is an expression of parts.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/error.hpp"
#include "trime/core/log.hpp"
#include "trime/facade/mesh.hpp"
#include "trime/facade/shape.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/vec2.hpp"

#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace trime {

struct RectangleForm {
  Box box;
};
struct CircleForm {
  Vec2 center;
  double radius;
};
struct RingsForm {
  std::vector<std::vector<Vec2>> rings;
};
struct FileForm {
  std::string path;
};
struct FunctionForm {
  std::function<double(Vec2)> distance;
  Box box;
};
struct DomainForm {};

/// A part of a shape, or an operation on at least two shapes.
struct Shape::Node {
  enum class Operation { part, unite, subtract, intersect };
  Operation operation = Operation::part;
  std::string name{}; ///< name of the part; empty for an operation
  std::variant<DomainForm, RectangleForm, CircleForm, RingsForm, FileForm, FunctionForm> form{};
  std::vector<Shape> operands{};
};

/// @brief Returns the value of the user's function at p.
/// @param what name of the function in messages
/// @throws GeometryError on this rank alone, with the place, if the function throws; an Error of the function is passed
/// on unchanged
inline double called(const std::function<double(geometry::Vec2)>& function, geometry::Vec2 p, const std::string& what) {
  try {
    return function(p);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw GeometryError(fmt::format("{} failed at ({:.9g}, {:.9g}): {}", what, p.x, p.y, error.what()));
  } catch (...) {
    throw GeometryError(fmt::format("{} failed at ({:.9g}, {:.9g}): it threw an exception that is not a std::exception",
                                    what, p.x, p.y));
  }
}

/// @brief Reads contour files on rank 0, chooses the container in the same way as trime_mpi, and makes the boundary
/// with its fixed points.
/// @throws ConfigError, GeometryError, FileError on all ranks together
/// @note Collective.
geometry::Domain build_domain(const Shape& shape, const MeshOptions& options, const comm::Communicator& comm, Log& log);

} // namespace trime
