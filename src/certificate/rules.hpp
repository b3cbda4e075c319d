// SPDX-License-Identifier: BSD-3-Clause
// How much the mesh may differ from the shape.
#pragma once

namespace trime::certificate {

/// The limits of the certificate.
struct CertificateRules {
  /// [side of the container] A boundary vertex lies no farther from the shape: curves are computed in doubles.
  static constexpr double vertex_limit = 1e-9;
  /// [h asked for] The curves that are meshed may always lie so far from those of the shape: distances are computed in
  /// doubles. Not measured.
  static constexpr double least_within = 1e-9;
  /// [h asked for] An arc of length h strays from its chord by h/2 at most, and sites may lie a little more than h
  /// apart. Where h was lowered, chords still leave out corners by shares of what was asked for: 240 meshes of
  /// archipelagos had 0.17 at most, but three of them 0.78 to 1.03 of the lowered h.
  static constexpr double chord_limit = 0.75;
  /// [l^2/8R] The sagitta of an arc of 60 degrees is 1.072 of that.
  static constexpr double arc_tolerance = 1.08;
  /// [h] On top of it: vertices lie on the lattice.
  static constexpr double arc_slack = 1e-3;
  /// [area of the shape] Between the mesh with its curved rim and the shape: sums of doubles.
  static constexpr double area_limit = 1e-10;
  /// [degrees] A curve that turns by so little more than the angle of corners may have been taken for one without a
  /// corner: angles are computed in doubles, in two ways. Not measured.
  static constexpr double angle_slack = 1e-6;
};

} // namespace trime::certificate
