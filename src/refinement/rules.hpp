// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the module refinement.
#pragma once

namespace trime::refinement {

/// Numbers that decide whether a new boundary vertex lies on the curve of the shape or in the middle of its edge.
struct RefinementRules {
  /// [side of the container] Vertices that lie so far from a curve still lie on it: as in
  /// CertificateRules::vertex_limit.
  static constexpr double on_curve = 1e-9;
  /// [length of the edge] Ends of boundary edges that lie so far from a curve still follow it: where the boundary was
  /// simplified, vertices lie near the curve. The new vertex then keeps the mean of their distances. Traced curves were
  /// moved by up to 1e-4 h, ragged coasts by up to 0.5 h.
  static constexpr double near_curve = 0.02;
  /// [length of the edge] A curve between the ends of an edge that is longer does not belong to the edge, but goes
  /// around a part of the shape that the mesh leaves out. An arc of 60 degrees is 1.05 times as long. Not measured.
  static constexpr double longest_curve = 3;
  /// [length of the edge] A vertex on the curve lies at most this far from the middle of the edge, so that it lies in
  /// the diametral circle of the edge, in which there are no other vertices.
  static constexpr double farthest = 0.5;
  /// [R/2r] Triangles with a larger alpha are bad, unless the triangle that was divided has a larger one: as in
  /// ExtractionRules::listed_alpha.
  static constexpr double bad_alpha = 2;
};

} // namespace trime::refinement
