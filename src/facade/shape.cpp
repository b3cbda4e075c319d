// SPDX-License-Identifier: BSD-3-Clause
#include "trime/facade/shape.hpp"

#include "facade/build_shape.hpp"
#include "trime/shape/region_shape.hpp"

namespace trime {
namespace {

using Operation = Shape::Node::Operation;

/// Operands of the same operation are taken over, where that does not change the set.
void append(std::vector<Shape>& operands, const Shape& shape, Operation operation) {
  if (shape.node().operation == operation)
    operands.insert(operands.end(), shape.node().operands.begin(), shape.node().operands.end());
  else
    operands.push_back(shape);
}

Shape joined(Operation operation, const Shape& a, const Shape& b) {
  Shape::Node node;
  node.operation = operation;
  append(node.operands, a, operation);
  if (operation == Operation::subtract) // a - (b - c) is not a - b - c
    node.operands.push_back(b);
  else
    append(node.operands, b, operation);
  return Shape(std::make_shared<const Shape::Node>(std::move(node)));
}

template <class Form>
Shape part(const std::string& name, Form form) {
  Shape::Node node;
  node.name = name;
  node.form = std::move(form);
  return Shape(std::make_shared<const Shape::Node>(std::move(node)));
}

} // namespace

Shape operator+(const Shape& a, const Shape& b) {
  return joined(Operation::unite, a, b);
}
Shape operator-(const Shape& a, const Shape& b) {
  return joined(Operation::subtract, a, b);
}
Shape operator&(const Shape& a, const Shape& b) {
  return joined(Operation::intersect, a, b);
}

std::string Shape::text() const {
  if (node_->operation == Operation::part)
    return node_->name;
  std::string text = node_->operation == Operation::unite      ? "union("
                     : node_->operation == Operation::subtract ? "difference("
                                                               : "intersection(";
  for (std::size_t k = 0; k < node_->operands.size(); ++k)
    text += (k == 0 ? "" : ", ") + node_->operands[k].text();
  return text + ")";
}

Shape rectangle(const std::string& name, Vec2 lower, Vec2 upper) {
  return part(name, RectangleForm{{lower, upper}});
}
Shape circle(const std::string& name, Vec2 center, double radius) {
  return part(name, CircleForm{center, radius});
}
Shape rings(const std::string& name, const std::vector<std::vector<Vec2>>& rings) {
  return part(name, RingsForm{rings});
}
Shape contour(const std::string& name, const std::string& path) {
  return part(name, FileForm{path});
}
Shape function(const std::string& name, std::function<double(Vec2)> distance, const Box& box) {
  return part(name, FunctionForm{std::move(distance), box});
}
Shape domain() {
  return part(std::string(shape::domain_name), DomainForm{});
}

} // namespace trime
