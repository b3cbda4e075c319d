// SPDX-License-Identifier: BSD-3-Clause
// The bad triangles in the middle of a patch, the worst first.
#pragma once

#include "cleanup/patch_rests.hpp"
#include "cleanup/patch_start.hpp"

#include <optional>
#include <vector>

namespace trime::cleanup {

/// @brief Chooses the triangle of a patch that is improved next. Triangles are identified by their corners, from the
/// largest index on, so that the way in which the triangulation stores them does not matter.
class PatchWorst {
public:
  /// References must outlive the object.
  PatchWorst(const PatchStart& start, const PatchRests& rests) : start_(start), rests_(rests) {}

  /// @brief Nothing has been tried; triangles above a limit are wanted.
  void begin(double above) {
    above_ = above;
    tried_.clear();
    forget();
  }
  /// Notes that the patch has changed: its triangles are listed again when they are needed.
  void forget() { is_listed_ = false; }

  /// The worst triangle that has not been tried and does not rest.
  std::optional<Corners> next(const Patch& now);
  /// @param corners as next() gives them
  void set_tried(const Corners& corners) { tried_.push_back(corners); }
  bool is_tried(const Corners& corners) const;

private:
  struct BadTriangle {
    Corners corners;
    double alpha;
  };
  static Corners largest_first(Corners corners);
  void list(const Patch& now);

  const PatchStart& start_;
  const PatchRests& rests_;
  double above_ = 0; // alpha
  std::vector<Corners> tried_;
  std::vector<BadTriangle> bad_;
  bool is_listed_ = false;
};

} // namespace trime::cleanup
