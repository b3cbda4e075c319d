// SPDX-License-Identifier: BSD-3-Clause
// Sizes as a program says them: a function of the place, or one of trime::sizes.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <concepts>
#include <functional>
#include <memory>
#include <type_traits>

namespace trime::sizing {
class SizeField;
}

namespace trime {

/// @brief How large triangles are, up to a factor that make_mesh chooses for MeshOptions::points or edge_length. Copies
/// are cheap.
class Size {
public:
  /// @brief Any function `double(Vec2)`: positive and finite in the shape, the same bits on every rank. Threads call it
  /// concurrently. Should it throw, or give anything else, all ranks throw a GeometryError that names the place.
  template <class Function>
  requires std::is_invocable_r_v<double, const Function&, geometry::Vec2> &&
      (!std::same_as<std::remove_cvref_t<Function>, Size>)Size(Function function)
      : function_(std::move(function)) {}
  /// A field of the lower level. @pre not null
  Size(std::shared_ptr<const sizing::SizeField> field) : field_(std::move(field)) {}

  /// A size is a function, a field, the automatic size, or none of them: then it is uniform.
  const std::function<double(geometry::Vec2)>& function() const { return function_; }
  const std::shared_ptr<const sizing::SizeField>& field() const { return field_; }
  bool is_automatic() const { return is_automatic_; }
  double gradation() const { return gradation_; } ///< gradation of the automatic size

private:
  Size() = default;
  friend Size uniform_size();
  friend Size automatic_size(double gradation);

  std::function<double(geometry::Vec2)> function_;
  std::shared_ptr<const sizing::SizeField> field_; ///< shared with the caller: it must live as long as this
  bool is_automatic_ = false;
  double gradation_ = 0;
};

Size uniform_size();
Size automatic_size(double gradation);

namespace sizes {

/// A size that is the same everywhere. make_mesh uses it by default.
inline Size uniform() {
  return uniform_size();
}
/// @brief Small where the boundary has small features, and growing by `gradation` per length from there. See
/// sizing::AutomaticSize. @param gradation 0: uniform; above 0.5, triangles can hardly follow
inline Size automatic(double gradation = 0.1) {
  return automatic_size(gradation);
}

} // namespace sizes
} // namespace trime
