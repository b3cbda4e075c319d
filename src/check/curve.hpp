// SPDX-License-Identifier: BSD-3-Clause
// The exact curves of the parts of a shape: distances, points inside, corners and samples.
#pragma once

#include "config_text.hpp"

#include <memory>
#include <vector>

namespace trime_check {

struct Box {
  Point min, max;
};

/// The middle of a piece of a curve, with a unit vector perpendicular to the curve.
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
  /// Returns the vertices at which the curve turns by more than this number of degrees.
  virtual std::vector<Point> corners(double degrees) const = 0;
  virtual double length() const = 0;
  /// Returns samples, one for each piece of the curve. A piece is at most `spacing` long and does not contain a vertex
  /// in its interior.
  virtual std::vector<CurveSample> samples(double spacing) const = 0;
};

/// Returns the bounding box of all vertices.
Box box_of(const std::vector<Ring>& rings);
/// Returns the four corners of a box as a ring.
std::vector<Ring> rectangle(const Box& box);

std::unique_ptr<Curve> make_circle(Point center, double radius);
/// Makes the curve of closed rings of straight sides; the even-odd rule decides what is inside.
std::unique_ptr<Curve> make_polygon(std::vector<Ring> rings);
/// Makes the curve of the sides of the container that are not periodic.
std::unique_ptr<Curve> make_container(const Box& box, const Periods& periods);

} // namespace trime_check
