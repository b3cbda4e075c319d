// SPDX-License-Identifier: BSD-3-Clause
// The element size along the curves of a boundary.
#pragma once

#include "sizing/lowered_size.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <optional>
#include <vector>

namespace trime::boundary {

/// @brief The relative size at places along all loops: the start of each piece, and places half a size apart behind it.
/// A boundary is laid many times in search of a factor, and a look-up of the field costs more than all else there.
/// Immutable, thread-safe.
class SizeSamples {
public:
  /// All threads. @throws GeometryError if the size at a place is not positive and finite, or asks for far too many
  SizeSamples(const geometry::Boundary& boundary, const sizing::SizeField& relative, const sizing::ScaledSize& asked);

  /// Are they near enough to each other for sizes with this factor?
  bool serve(double factor) const { return factor >= 0.75 * factor_; }

  /// Where the last look-up in a loop found its place.
  struct Cursor {
    std::size_t index = 0;
  };
  /// Linear between the samples. O(1) for places in ascending order. @param whole the length of the piece
  double at(std::size_t loop, LocalIndex piece, double along, double whole, Cursor& cursor) const;

private:
  struct Sample {
    double along, relative;
    LocalIndex piece;
  };
  struct OfLoop {
    std::vector<Sample> samples;
    std::vector<std::size_t> first; // of each piece, and the end
  };
  double factor_;
  std::vector<OfLoop> loops_;
};

/// The size at a place, as it is and as it was asked for before anything lowered it.
struct SizePair {
  double size = 0, asked = 0;
};

/// @brief Both sizes along a boundary, from the fields themselves or from samples of the relative size. Keeps
/// references.
class BoundarySizes {
public:
  BoundarySizes(const sizing::SizeField& size, const sizing::SizeField& asked) : size_(size), asked_(asked) {}

  struct Sampled {
    const SizeSamples& relative;
    const sizing::ScaledSize& asked;    ///< of the last stage
    const sizing::LoweredSize* lowered; ///< the same within limits; null without any
    double coarsening;                  ///< h of this stage over that of the last
  };
  BoundarySizes(const sizing::SizeField& size, const sizing::SizeField& asked, const Sampled& sampled)
      : size_(size), asked_(asked), sampled_(sampled) {}

  bool is_uniform() const { return size_.is_uniform() && asked_.is_uniform(); }
  const sizing::SizeField& asked() const { return asked_; }

  struct PiecePlace {
    std::size_t loop;
    LocalIndex piece;
    double along, whole;      ///< arc length from the start of the piece, and of all of it
    geometry::Vec2 canonical; ///< the same place in the container
  };
  /// @throws GeometryError if a size is not positive and finite
  SizePair at(const PiecePlace& place, SizeSamples::Cursor& cursor) const;

private:
  const sizing::SizeField &size_, &asked_;
  std::optional<Sampled> sampled_;
};

} // namespace trime::boundary
