// SPDX-License-Identifier: BSD-3-Clause
// The content of a Shape: an expression of parts as the user gave them.
#pragma once

#include "trime/facade/shape.hpp"

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

/// A part, or an operation on at least two operands.
struct Shape::Node {
  enum class Operation { part, unite, subtract, intersect };
  Operation operation = Operation::part;
  std::string name{}; ///< name of a part
  std::variant<DomainForm, RectangleForm, CircleForm, RingsForm, FileForm, FunctionForm> form{};
  std::vector<Shape> operands{};
};

} // namespace trime
