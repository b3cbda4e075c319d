// SPDX-License-Identifier: BSD-3-Clause
#include "trime/shape/region_shape.hpp"

#include "shape/make_boundary.hpp"
#include "shape/part_images.hpp"
#include "trime/core/error.hpp"
#include "trime/shape/traced_part.hpp"

#include <unordered_set>

namespace trime::shape {

namespace {

using geometry::Frame;
using geometry::Vec2;

std::vector<std::string> names_of(const std::vector<Part>& parts) {
  std::vector<std::string> names;
  std::unordered_set<std::string> known;
  for (const Part& part : parts) {
    if (part.name() == domain_name)
      throw ConfigError(fmt::format("a part must not be named '{}': this name means the container", domain_name));
    if (!known.insert(part.name()).second)
      throw ConfigError(fmt::format("two parts are named '{}'; expected different names", part.name()));
    names.push_back(part.name());
  }
  return names;
}

} // namespace

RegionShape::RegionShape(std::vector<Part> parts, std::string_view region, const Frame& frame)
    : parts_(std::move(parts)), region_(Region::parse(region, names_of(parts_))),
      domain_(make_boundary(region_, parts_, frame)), tree_(domain_.boundary()) {
  parts_.push_back(domain_part(frame));
  shifts_.resize(parts_.size());
  for (const int part : region_.parts())
    shifts_[part] = image_shifts(parts_[part], frame);
}

bool RegionShape::inside(Vec2 p) const {
  const Vec2 canonical = frame().periods().wrap(p);
  return region_.contains([&](int part) {
    for (const Vec2 shift : shifts_[part])
      if (parts_[part].inside(canonical - shift))
        return true;
    return false;
  });
}

geometry::Domain domain_of(std::vector<Part> parts, std::string_view region, const Frame& frame) {
  return make_boundary(Region::parse(region, names_of(parts)), std::move(parts), frame);
}

RegionShape traced(const tracing::Shape& shape, const Frame& frame, const std::string& name) {
  return RegionShape({traced_part(name, shape, frame)}, name, frame);
}

} // namespace trime::shape
