// SPDX-License-Identifier: BSD-3-Clause
// Objects that keep references do not accept temporaries, which would be gone when they are used.
#include "sizing/lowered_size.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/sizing/size_field.hpp"
#include "trime/tracing/shape.hpp"

#include <type_traits>

namespace trime {
namespace {

using geometry::Box;
using geometry::Domain;
using sizing::ScaledSize;
using sizing::SizeField;
using sizing::UniformSize;

static_assert(std::is_constructible_v<sizing::ExpressionSize, const Formula&, Box>);
static_assert(!std::is_constructible_v<sizing::ExpressionSize, Formula, Box>);

static_assert(std::is_constructible_v<tracing::ExpressionShape, const Formula&>);
static_assert(!std::is_constructible_v<tracing::ExpressionShape, Formula>);

static_assert(std::is_constructible_v<ScaledSize, const UniformSize&, double>);
static_assert(!std::is_constructible_v<ScaledSize, UniformSize, double>);
static_assert(!std::is_constructible_v<ScaledSize, UniformSize, double, double>);
static_assert(!std::is_constructible_v<ScaledSize, UniformSize, double, double, double>);

template <class Field>
constexpr bool lowers =
    std::is_constructible_v<sizing::LoweredSize, Field, std::initializer_list<sizing::GradedLimits>, geometry::Periods>;
static_assert(lowers<const UniformSize&> && !lowers<UniformSize>);

template <class Region, class Size>
constexpr bool makes_meshes = std::is_constructible_v<meshing::Mesher, const comm::Communicator&, Region, Size,
                                                      meshing::MeshOptions, Log&, TimerTable&>;
static_assert(makes_meshes<const Domain&, const SizeField&>);
static_assert(makes_meshes<Domain&, UniformSize&>);
static_assert(!makes_meshes<Domain, const SizeField&>);
static_assert(!makes_meshes<const Domain&, UniformSize>);
static_assert(!makes_meshes<Domain, UniformSize>);

} // namespace
} // namespace trime
