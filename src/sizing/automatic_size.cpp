// SPDX-License-Identifier: BSD-3-Clause
#include "trime/sizing/automatic_size.hpp"

#include "cones/size_quadtree.hpp"
#include "core/angle.hpp"
#include "sizing/boundary_features.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sizing {

namespace {

using cones::ConeTree;
using cones::SizeQuadtree;

constexpr double least_side_share = 1.0 / 128; // of the feature floor: smallest cell that is split

std::unique_ptr<const SizeQuadtree> make_tree(const comm::Communicator& comm, const geometry::Boundary& boundary,
                                              const AutomaticSizeOptions& options, const Images& images) {
  const ConeTree cones(boundary_features(comm, boundary, images, options.feature_floor, options.gradation),
                       options.gradation);
  return std::make_unique<SizeQuadtree>(
      comm, SizeQuadtree::Source{cones, options.gradation, options.container.width() + options.container.height(),
                                 options.container, least_side_share * options.feature_floor});
}

} // namespace

double feature_floor(std::optional<GlobalId> points, std::optional<double> edge_length, double area) {
  if (edge_length)
    return 0.5 * *edge_length;
  return 0.5 * std::sqrt(2 / sqrt_3 * area / static_cast<double>(std::max<GlobalId>(points.value_or(1), 1)));
}

AutomaticSize::AutomaticSize(const comm::Communicator& comm, const geometry::Boundary& boundary,
                             const AutomaticSizeOptions& options)
    : images_(std::make_unique<Images>(options.container, options.period_x, options.period_y)),
      tree_(make_tree(comm, boundary, options, *images_)), gradation_(options.gradation) {}

AutomaticSize::~AutomaticSize() = default;

double AutomaticSize::size(geometry::Vec2 p) const {
  return tree_->value(images_->wrap(p));
}

double AutomaticSize::least() const {
  return tree_->least();
}

double AutomaticSize::largest() const {
  return tree_->largest();
}

std::size_t AutomaticSize::memory_bytes() const {
  return tree_->memory_bytes();
}

std::unique_ptr<SizeField> make_automatic_size(const comm::Communicator& comm, const geometry::Boundary& boundary,
                                               const AutomaticSizeOptions& options) {
  const geometry::Box& box = options.container;
  if (!(options.gradation >= 0) || !std::isfinite(options.gradation))
    throw ConfigError(fmt::format("expected a finite gradation of at least 0, found {}", options.gradation));
  if (options.gradation == 0 || boundary.loops.empty())
    return std::make_unique<UniformSize>();
  if (!(box.width() > 0) || !(box.height() > 0) || !std::isfinite(box.width()) || !std::isfinite(box.height()))
    throw ConfigError(fmt::format("expected a container with an area, found {} by {}", box.width(), box.height()));
  if (!(options.feature_floor > 0) || !std::isfinite(options.feature_floor))
    throw ConfigError(fmt::format("expected a positive length below which features are not resolved, found {}",
                                  options.feature_floor));
  return std::make_unique<AutomaticSize>(comm, boundary, options);
}

} // namespace trime::sizing
