// SPDX-License-Identifier: BSD-3-Clause
// Gives the element size along the curves of a boundary.
#pragma once

#include "sizing/lowered_size.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <optional>
#include <vector>

namespace trime::boundary {

/// @brief Samples the relative size along all loops: at the start of each piece, and then at distances of half a size.
/// During the search for a factor, a boundary is laid many times, and evaluating the field would take most of the time.
/// Immutable, thread-safe.
class SizeSamples {
public:
  /// Uses all threads. @throws GeometryError if the size at a place is not positive and finite, or needs far too many
  /// samples
  SizeSamples(const geometry::Boundary& boundary, const sizing::SizeField& relative, const sizing::ScaledSize& asked);

  /// Returns whether the samples are dense enough for sizes with this factor.
  bool serve(double factor) const { return factor >= 0.75 * factor_; }

  /// The place of the last look-up in a loop.
  struct Cursor {
    std::size_t index = 0;
  };
  /// Returns the size at a place by linear interpolation. O(1) for places in ascending order. @param whole the length
  /// of the piece
  double at(std::size_t loop, LocalIndex piece, double along, double whole, Cursor& cursor) const;

private:
  struct Sample {
    double along, relative;
    LocalIndex piece;
  };
  struct OfLoop {
    std::vector<Sample> samples;
    std::vector<std::size_t> first; // first sample of each piece, and the end
  };
  double factor_;
  std::vector<OfLoop> loops_;
};

/// The size at a place, and the size asked for before it was lowered.
struct SizePair {
  double size = 0, asked = 0;
};

/// @brief Gives both sizes along a boundary, from the fields or from samples of the relative size. Keeps references.
class BoundarySizes {
public:
  BoundarySizes(const sizing::SizeField& size, const sizing::SizeField& asked) : size_(size), asked_(asked) {}

  struct Sampled {
    const SizeSamples& relative;
    const sizing::ScaledSize& asked;    ///< size asked for in the last stage
    const sizing::LoweredSize* lowered; ///< that size, lowered by limits; null if there are no limits
    double coarsening;                  ///< h of this stage over h of the last stage
  };
  BoundarySizes(const sizing::SizeField& size, const sizing::SizeField& asked, const Sampled& sampled)
      : size_(size), asked_(asked), sampled_(sampled) {}

  bool is_uniform() const { return size_.is_uniform() && asked_.is_uniform(); }
  const sizing::SizeField& asked() const { return asked_; }

  struct PiecePlace {
    std::size_t loop;
    LocalIndex piece;
    double along, whole;      ///< arc length from the start of the piece, and length of the piece
    geometry::Vec2 canonical; ///< this place in the container
  };
  /// @throws GeometryError if a size is not positive and finite
  SizePair at(const PiecePlace& place, SizeSamples::Cursor& cursor) const;

private:
  const sizing::SizeField &size_, &asked_;
  std::optional<Sampled> sampled_;
};

} // namespace trime::boundary
