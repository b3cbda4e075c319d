// SPDX-License-Identifier: BSD-3-Clause
#include "facade/build_size.hpp"

#include "facade/called.hpp"
#include "trime/sizing/automatic_size.hpp"

namespace trime {

Size uniform_size() {
  return {};
}

Size automatic_size(double gradation) {
  Size size;
  size.gradation_ = gradation;
  size.is_automatic_ = true;
  return size;
}

namespace {

/// A function of the user as the lower level asks it.
class CalledSize final : public sizing::SizeField {
public:
  explicit CalledSize(const std::function<double(geometry::Vec2)>& function) : function_(function) {}
  double size(geometry::Vec2 p) const override { return called(function_, p, "the size function"); }

private:
  const std::function<double(geometry::Vec2)>& function_;
};

} // namespace

std::shared_ptr<const sizing::SizeField> build_size(const Size& size, const geometry::Domain& domain,
                                                    const meshing::MeshOptions& options,
                                                    const comm::Communicator& comm) {
  if (size.field())
    return size.field();
  if (size.function())
    return std::make_shared<const CalledSize>(size.function());
  if (!size.is_automatic())
    return std::make_shared<const sizing::UniformSize>();
  const geometry::Boundary& boundary = domain.boundary();
  sizing::AutomaticSizeOptions automatic;
  automatic.gradation = size.gradation();
  automatic.feature_floor = sizing::feature_floor(options.points, options.edge_length, boundary.area);
  automatic.container = domain.frame().container();
  automatic.period_x = boundary.periods.x;
  automatic.period_y = boundary.periods.y;
  return sizing::make_automatic_size(comm, boundary, automatic);
}

} // namespace trime
