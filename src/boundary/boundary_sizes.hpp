// SPDX-License-Identifier: BSD-3-Clause
// Gives the target edge length h along the curves of a boundary.
#pragma once

#include "sizing/lowered_size.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <optional>
#include <vector>

namespace trime::boundary {

/// @brief Samples the relative size along all loops: at the start of each piece, and then at distances of half a size.
/// The search for the factor of the size places sites on the boundary many times, and evaluating the size field each
/// time would dominate its cost. Immutable, thread-safe.
class SizeSamples {
public:
  /// Uses all threads.
  /// @throws GeometryError if the size at a place is not positive and finite, or so small that it needs far too many
  /// samples
  SizeSamples(const geometry::Boundary& boundary, const sizing::SizeField& relative, const sizing::ScaledSize& asked);

  /// Returns whether the samples are dense enough for the size with this factor.
  bool serve(double factor) const { return factor >= 0.75 * factor_; }

  /// Keeps the position of the last look-up in a loop, so that the next one is fast.
  struct Cursor {
    std::size_t index = 0;
  };
  /// Returns the relative size at a place by linear interpolation. Cost: O(1) if places are looked up in ascending
  /// order.
  /// @param along arc length from the start of the piece
  /// @param whole the length of the piece
  double at(std::size_t loop, LocalIndex piece, double along, double whole, Cursor& cursor) const;

private:
  struct Sample {
    double along, relative;
    LocalIndex piece;
  };
  struct OfLoop {
    std::vector<Sample> samples;
    std::vector<std::size_t> first; // index of the first sample of each piece, and the end
  };
  double factor_;
  std::vector<OfLoop> loops_;
};

/// The size at a place, and the size that the user asked for there before it was lowered.
struct SizePair {
  double size = 0, asked = 0;
};

/// @brief Gives the size and the asked size along a boundary, from the size fields or from samples. Keeps references to
/// its arguments.
class BoundarySizes {
public:
  BoundarySizes(const sizing::SizeField& size, const sizing::SizeField& asked) : size_(size), asked_(asked) {}

  struct Sampled {
    const SizeSamples& relative;
    const sizing::ScaledSize& asked; ///< the size that the last stage asks for
    const sizing::LoweredSize*
        lowered;       ///< `asked`, lowered near narrow parts of the boundary; null if it is lowered nowhere
    double coarsening; ///< h of this stage divided by h of the last stage
  };
  BoundarySizes(const sizing::SizeField& size, const sizing::SizeField& asked, const Sampled& sampled)
      : size_(size), asked_(asked), sampled_(sampled) {}

  bool is_uniform() const { return size_.is_uniform() && asked_.is_uniform(); }
  const sizing::SizeField& asked() const { return asked_; }

  struct PiecePlace {
    std::size_t loop;
    LocalIndex piece;
    double along, whole;      ///< arc length from the start of the piece, and the length of the piece
    geometry::Vec2 canonical; ///< position of the place in the container
  };
  /// Returns both sizes at a place.
  /// @throws GeometryError if a size is not positive and finite
  SizePair at(const PiecePlace& place, SizeSamples::Cursor& cursor) const;

private:
  const sizing::SizeField &size_, &asked_;
  std::optional<Sampled> sampled_;
};

} // namespace trime::boundary
