// SPDX-License-Identifier: BSD-3-Clause
// The limits for differences between the mesh and the shape.
#pragma once

namespace trime::certificate {

/// The limits of the certificate.
struct CertificateRules {
  /// [side of the container] Largest distance of a boundary vertex from the shape. It is not zero because curves are
  /// computed in doubles.
  static constexpr double vertex_limit = 1e-9;
  /// [h asked for] Distance by which the meshed curves may always differ from those of the shape, because distances are
  /// computed in doubles. Not measured.
  static constexpr double least_within = 1e-9;
  /// [h asked for] Largest distance of a curve from its boundary edge. An arc of length h deviates by at most h/2, and
  /// sites may be slightly more than h apart. Where h was lowered, boundary edges may still leave out corners by a
  /// share of the h that was asked for. 240 meshes of archipelagos had at most 0.17 of that h; three of them had 0.78
  /// to 1.03 of the lowered h.
  static constexpr double chord_limit = 0.75;
  /// [l^2/8R] Largest distance of an arc from its boundary edge of length l. The sagitta of an arc of 60 degrees with
  /// radius R is 1.072 l^2/8R.
  static constexpr double arc_tolerance = 1.08;
  /// [h] Tolerance in addition to arc_tolerance, because vertices are rounded to the coordinate lattice.
  static constexpr double arc_slack = 1e-3;
  /// [area of the shape] Largest difference between the area of the shape and the area of the mesh with curved boundary
  /// edges. It is not zero because both are sums of doubles.
  static constexpr double area_limit = 1e-10;
  /// [degrees] A turn that exceeds the angle of corners by at most this may or may not count as a corner, because
  /// angles are computed in doubles in two ways. Not measured.
  static constexpr double angle_slack = 1e-6;
};

} // namespace trime::certificate
