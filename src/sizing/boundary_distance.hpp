// SPDX-License-Identifier: BSD-3-Clause
// The distance to the parts of a boundary that have a given name, and sizes that grow with this distance.
#pragma once

#include "core/distance_formula.hpp"
#include "sizing/piece_locator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace trime::sizing {

/// @brief Returns the parts with this name, as ascending indices into `part_names`. A part `water.open sea` has the
/// names `water.open sea`, `water` and `open sea`. The empty name means all parts.
/// @throws ConfigError that lists the known names if there is no such part
std::vector<int> parts_named(std::string_view name, const std::vector<std::string>& part_names);

/// Name of the fixed points among the named curves.
inline constexpr const char* fixed_points_name = "fixed_points";

/// @brief Returns the names to which distances can be measured: the parts of the boundary, curves inside, pairs of
/// regions, and fixed points if the domain has any.
std::vector<std::string> curve_names(const geometry::Domain& domain);

/// @brief Returns the boundary of a domain, and its inner curves as further loops, with the names curve_names(domain).
/// A fixed point is a piece of length 0. The result is a list of named curves; it bounds no shape if there is more than
/// the boundary.
geometry::Boundary named_curves(const geometry::Domain& domain);

/// Returns the periodic images of what lies in the container of the domain.
Images images_of(const geometry::Domain& domain);

/// Returns how a formula finds the distance to the boundary or to named curves of a domain, which must outlive the
/// result. The functions that it returns do not need the domain.
DistanceLookup distances_in(const geometry::Domain& domain);

/// @brief Finds the distance to the parts of a boundary. Immutable; queries are thread-safe and give the same bits on
/// every rank.
///
/// Seen from far away, many short pieces are almost equally near. Therefore coarser copies of the curves are kept, and
/// a query uses the coarsest copy that is precise enough for the distance.
class BoundaryDistance {
public:
  /// Builds the copies and their search trees in O(M log M) time for M pieces.
  /// @param images those of the container of the boundary
  /// @throws ConfigError if no part has the name, or if the parts with this name have no piece
  BoundaryDistance(const geometry::Boundary& boundary, std::string_view name, const Images& images);

  /// Returns the distance from p to the nearest point of these parts and of their periodic images. The distance is
  /// correct within 0.07 %, see PieceLocator::slack and `far_deviation`. Cost: O(log M) for curves.
  double distance(geometry::Vec2 p) const;
  /// Returns the smaller one of this distance and `reach`. A small reach makes the search faster.
  double distance_within(geometry::Vec2 p, double reach) const;

  /// [1] A copy whose distance from the curves is at most this share of a distance is precise enough for it.
  static constexpr double far_deviation = 2e-4;

private:
  struct Copy {
    double deviation; ///< largest distance between the copy and the curves
    PieceLocator locator;
  };
  Images images_;
  std::vector<Copy> copies_; ///< the coarsest one first; the last one holds the curves themselves
};

/// A length that the size has on the parts of the boundary with a name.
struct NamedSize {
  std::string name;
  double size; ///< positive
};

/// @brief The size min(field(x), min over names k of size_k + gradation * distance to the parts with name k).
class BoundarySize final : public SizeField {
public:
  /// @pre `field` outlives this object, gradation > 0
  /// @throws ConfigError for an unknown name, or if a part has two names with different sizes
  BoundarySize(const SizeField& field, const geometry::Boundary& boundary, const std::vector<NamedSize>& sizes,
               double gradation, const Images& images);
  /// Returns the size at p. An invalid size of the field is returned unchanged.
  double size(geometry::Vec2 p) const override;
  bool jumps() const override { return field_.jumps(); }

private:
  struct Source {
    double size;
    BoundaryDistance distance;
  };
  const SizeField& field_;
  double gradation_;
  std::vector<Source> sources_;
};

} // namespace trime::sizing
