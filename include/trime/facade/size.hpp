// SPDX-License-Identifier: BSD-3-Clause
// Sizes in a program: the target edge length as a function of the place, or one of the sizes in trime::sizes.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <concepts>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace trime::sizing {
class SizeField;
}

namespace trime {

struct NamedSize;

/// @brief The target edge length of the triangles, up to a factor that make_mesh chooses so that the mesh has
/// MeshOptions::points or edge_length. Copies are cheap.
class Size {
public:
  /// @brief Takes any function `double(Vec2)`, which must be positive and finite in the shape, with the same bits on
  /// every rank. Threads call it concurrently. If it throws or returns another value, all ranks throw a GeometryError
  /// that names the place.
  template <class Function>
  requires std::is_invocable_r_v<double, const Function&, geometry::Vec2> &&
      (!std::same_as<std::remove_cvref_t<Function>, Size>)Size(Function function)
      : function_(std::move(function)) {}
  /// Takes a SizeField, such as your own class derived from it.
  /// @pre not null
  Size(std::shared_ptr<const sizing::SizeField> field) : field_(std::move(field)) {}

  /// A size is one of these: a function, a field, a formula, the automatic size, the smallest one of several sizes, or
  /// (if none is set) a uniform size.
  const std::function<double(geometry::Vec2)>& function() const { return function_; }
  const std::shared_ptr<const sizing::SizeField>& field() const { return field_; }
  bool is_automatic() const { return is_automatic_; }
  double gradation() const { return gradation_; } ///< gradation of the automatic size
  /// The formula of a size that is one; otherwise empty.
  const std::string& formula() const { return formula_; }
  bool is_minimum() const { return parts_ != nullptr; } ///< whether it is the smallest one of several sizes
  /// The sizes whose smallest one this is; empty for other sizes.
  std::span<const NamedSize> parts() const;

private:
  Size() = default;
  friend Size uniform_size();
  friend Size automatic_size(double gradation);
  friend Size formula_size(const std::string& text);
  friend Size smallest_size(std::vector<NamedSize> sizes);

  std::function<double(geometry::Vec2)> function_;
  std::shared_ptr<const sizing::SizeField>
      field_; ///< shared with the caller, whose field must exist as long as this object
  std::string formula_;
  std::shared_ptr<const std::vector<NamedSize>> parts_; ///< shared by all copies; immutable
  bool is_automatic_ = false;
  double gradation_ = 0;
};

/// A size with a name, as one of several sizes.
struct NamedSize {
  std::string name; ///< letters, digits, `_` and `-`
  Size size;
};

Size uniform_size();
Size automatic_size(double gradation);
Size formula_size(const std::string& text);
Size smallest_size(std::vector<NamedSize> sizes);

namespace sizes {

/// Returns a size that is the same everywhere. make_mesh uses it by default.
inline Size uniform() {
  return uniform_size();
}
/// @brief Returns a size that is small where the boundary has small features, and grows from there by `gradation` per
/// unit of distance. See sizing::AutomaticSize.
/// @param gradation 0: uniform; above 0.5, triangles can hardly follow the size
inline Size automatic(double gradation = 0.1) {
  return automatic_size(gradation);
}
/// @brief Returns the size that a config gives by the key `expression`: a formula of x, y, and of the distance to the
/// boundary, dist(), or to a part of it, dist(NAME), such as "0.01 + 0.1*dist(hole)". See configs/sizes.md. If the
/// formula is wrong, make_mesh throws a ConfigError on all ranks.
inline Size formula(const std::string& text) {
  return formula_size(text);
}
/// @brief Returns the smallest one of several sizes at each place, such as
/// `smallest({{"wave", sizes::formula("0.02 + 0.02*x")}, {"coast", near_coast}})`. These are the sections
/// `[size.NAME]` of a config; the name `sizing` stands for its section `[sizing]`. Mesh::size_shares says how many
/// points each size decides. The values of the sizes are compared as they are, so all must be lengths, or all relative:
/// an automatic size, which is a length, and a relative formula mix units.
/// @param sizes at least one, with different names, in the same order on all ranks; none is uniform or a minimum
/// itself, otherwise make_mesh throws a ConfigError on all ranks. MeshOptions::max_size bounds all of them
inline Size smallest(std::vector<NamedSize> sizes) {
  return smallest_size(std::move(sizes));
}

} // namespace sizes
} // namespace trime
