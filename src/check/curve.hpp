// SPDX-License-Identifier: BSD-3-Clause
// The exact curves of the parts of a shape, with their distances, insides, corners and samples.
#pragma once

#include "config_text.hpp"

#include <memory>
#include <vector>

namespace trime_check {

struct Box {
  Point min, max;
};

/// The middle of a piece of a curve, and a unit vector perpendicular to the curve.
struct CurveSample {
  Point place, normal;
  double length = 0; ///< length of the piece
};

/// The curve of one part of a shape.
class Curve {
public:
  virtual ~Curve() = default;
  virtual double distance(Point p) const = 0;
  virtual bool contains(Point p) const = 0;
  virtual Box box() const = 0;
  /// Returns the vertices that turn by more than this number of degrees.
  virtual std::vector<Point> corners(double degrees) const = 0;
  virtual double length() const = 0;
  /// Returns samples of pieces that are no longer than `spacing` and do not cross a vertex.
  virtual std::vector<CurveSample> samples(double spacing) const = 0;
};

/// Returns the box of all vertices.
Box box_of(const std::vector<Ring>& rings);
/// Returns the corners of a box as a ring.
std::vector<Ring> rectangle(const Box& box);

std::unique_ptr<Curve> make_circle(Point center, double radius);
/// Makes the curve of closed rings of straight sides; the even-odd rule decides what is inside.
std::unique_ptr<Curve> make_polygon(std::vector<Ring> rings);
/// Makes the curve of the sides of the container that are not periodic.
std::unique_ptr<Curve> make_container(const Box& box, const Periods& periods);

} // namespace trime_check
