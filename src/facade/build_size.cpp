// SPDX-License-Identifier: BSD-3-Clause
#include "facade/build_size.hpp"

#include "core/distance_formula.hpp"
#include "facade/build_shape.hpp"
#include "sizing/boundary_distance.hpp"
#include "sizing/distance_size.hpp"
#include "sizing/region_size.hpp"
#include "sizing/rules.hpp"
#include "trime/sizing/automatic_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace trime {

Size uniform_size() {
  return {};
}

Size formula_size(const std::string& text) {
  Size size;
  size.formula_ = text;
  return size;
}

Size smallest_size(std::vector<NamedSize> sizes) {
  Size size;
  size.parts_ = std::make_shared<const std::vector<NamedSize>>(std::move(sizes));
  return size;
}

std::span<const NamedSize> Size::parts() const {
  return parts_ ? std::span<const NamedSize>(*parts_) : std::span<const NamedSize>();
}

Size automatic_size(double gradation) {
  Size size;
  size.gradation_ = gradation;
  size.is_automatic_ = true;
  return size;
}

namespace {

// The section of a config with the size to which sections [size.NAME] are added.
constexpr const char* main_section = "sizing";

/// A size together with the one that it bounds in regions.
class OwnedRegionSize final : public sizing::SizeField {
public:
  OwnedRegionSize(std::shared_ptr<const sizing::SizeField> field, const geometry::Domain& domain,
                  std::vector<sizing::RegionBound> bounds)
      : field_(std::move(field)), bounded_(*field_, domain, std::move(bounds)) {}
  double size(geometry::Vec2 p) const override { return bounded_.size(p); }
  void sizes(std::span<const geometry::Vec2> places, std::span<double> values) const override {
    bounded_.sizes(places, values);
  }
  bool prefers_blocks() const override { return bounded_.prefers_blocks(); }
  bool jumps() const override { return true; }
  std::size_t memory_bytes() const override { return bounded_.memory_bytes(); }

private:
  std::shared_ptr<const sizing::SizeField> field_;
  sizing::RegionSize bounded_;
};

/// A function of the user as the lower level asks it.
class CalledSize final : public sizing::SizeField {
public:
  explicit CalledSize(const std::function<double(geometry::Vec2)>& function) : function_(function) {}
  double size(geometry::Vec2 p) const override { return called(function_, p, "the size function"); }

private:
  const std::function<double(geometry::Vec2)>& function_;
};

/// A formula of a config, together with the size that it gives.
class FormulaSize final : public sizing::SizeField {
public:
  FormulaSize(const std::string& text, const geometry::Domain& domain)
      : formula_(text, "the formula of the size", sizing::distances_in(domain)), size_(formula_, box_of(domain)) {}
  double size(geometry::Vec2 p) const override { return size_.size(p); }

private:
  static Box box_of(const geometry::Domain& domain) {
    return domain.frame().periods().any() ? domain.frame().container() : domain.boundary().bounding_box();
  }

  DistanceFormula formula_;
  sizing::DistanceSize size_;
};

/// Several sizes with their minimum.
struct OwnedMinimum {
  explicit OwnedMinimum(std::vector<std::shared_ptr<const sizing::SizeField>> fields)
      : owned(std::move(fields)), minimum(pointers(owned)) {}

  std::vector<std::shared_ptr<const sizing::SizeField>> owned;
  sizing::MinimumSize minimum;

private:
  static std::vector<const sizing::SizeField*>
  pointers(const std::vector<std::shared_ptr<const sizing::SizeField>>& fields) {
    std::vector<const sizing::SizeField*> all;
    std::ranges::transform(fields, std::back_inserter(all), [](const auto& field) { return field.get(); });
    return all;
  }
};

/// The name of the section that gives this size in a config.
std::string section_of(const NamedSize& named) {
  return named.name == main_section ? named.name : "size." + named.name;
}

/// One size. Collective.
std::shared_ptr<const sizing::SizeField> single_size(const Size& size, const geometry::Domain& domain,
                                                     const meshing::MeshOptions& options,
                                                     const comm::Communicator& comm) {
  if (size.field())
    return size.field();
  if (size.function())
    return std::make_shared<const CalledSize>(size.function());
  if (!size.formula().empty())
    return std::make_shared<const FormulaSize>(size.formula(), domain);
  if (!size.is_automatic())
    return std::make_shared<const sizing::UniformSize>(options.absolute_sizes ? options.max_size.value_or(1) : 1.0);
  const geometry::Boundary& boundary = domain.boundary();
  sizing::AutomaticSizeOptions automatic;
  automatic.gradation = size.gradation();
  automatic.feature_floor = options.absolute_sizes
                                ? options.min_size.value_or(0)
                                : sizing::feature_floor(options.points, options.edge_length, boundary.area);
  automatic.container = domain.frame().container();
  automatic.period_x = boundary.periods.x;
  automatic.period_y = boundary.periods.y;
  return sizing::make_automatic_size(comm, boundary, automatic);
}

/// The size before it is bounded in regions. Collective.
BuiltSize common_size(const Size& size, const geometry::Domain& domain, const meshing::MeshOptions& options,
                      const comm::Communicator& comm) {
  if (size.parts().empty())
    return {single_size(size, domain, options, comm)};
  std::vector<std::shared_ptr<const sizing::SizeField>> fields;
  BuiltSize built;
  for (const NamedSize& named : size.parts()) {
    built.names.push_back(section_of(named));
    fields.push_back(single_size(named.size, domain, options, comm));
  }
  const auto owner = std::make_shared<const OwnedMinimum>(std::move(fields));
  built.minimum = {owner, &owner->minimum};
  built.field = built.minimum;
  return built;
}

/// The growth of an automatic size, if it has a limit.
std::optional<double> automatic_growth(const Size& size) {
  return size.is_automatic() && size.gradation() > 0 ? std::optional(size.gradation()) : std::nullopt;
}

} // namespace

BuiltSize build_size(const Size& size, const geometry::Domain& domain, const std::vector<Region>& regions,
                     const meshing::MeshOptions& options, const comm::Communicator& comm) {
  std::vector<sizing::RegionBound> bounds;
  for (std::size_t k = 0; k < regions.size(); ++k)
    if (regions[k].size)
      bounds.push_back({static_cast<int>(k) + 1, *regions[k].size});
  BuiltSize built = common_size(size, domain, options, comm);
  if (bounds.empty())
    return built;
  built.field = std::make_shared<const OwnedRegionSize>(std::move(built.field), domain, std::move(bounds));
  built.lowered_by = "regions";
  return built;
}

std::optional<double> default_growth(const Size& size, bool regions_are_sized) {
  if (size.is_automatic())
    return automatic_growth(size);
  for (const NamedSize& named : size.parts())
    if (const std::optional<double> growth = automatic_growth(named.size))
      return growth;
  const bool is_graded = size.function() || size.field() || !size.formula().empty() || !size.parts().empty();
  return is_graded || regions_are_sized ? std::optional(sizing::SizingRules::function_gradation) : std::nullopt;
}

std::string text_of(const Size& size) {
  if (size.is_automatic())
    return fmt::format("automatic, gradation {:.6g}", size.gradation());
  if (!size.formula().empty())
    return "expression " + size.formula();
  if (!size.is_minimum())
    return size.function() || size.field() ? "a function of the program" : "uniform";
  std::string text;
  for (const NamedSize& named : size.parts()) {
    const std::string& formula = named.size.formula();
    text += text.empty() ? "the smallest of " : ", ";
    text += named.name == main_section ? text_of(named.size)
                                       : named.name + " = " + (formula.empty() ? text_of(named.size) : formula);
  }
  return text;
}

} // namespace trime
