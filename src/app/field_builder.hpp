// SPDX-License-Identifier: BSD-3-Clause
// Reads the data of the sections [field.NAME], which the formula of the size uses.
#pragma once

#include "app/options.hpp"
#include "app/shape_builder.hpp"
#include "core/distance_formula.hpp"
#include "fields/read_field.hpp"
#include "trime/comm/communicator.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace trime::app {

/// A field with the conversion from places of the mesh.
struct BuiltField {
  std::string name;
  std::shared_ptr<const fields::Field> field;
  fields::ToFile to_file;
  bool in_metres = false; ///< whether degrees of the file become metres in gradients
  std::uint64_t hash = 0; ///< see fields::ReadField
  std::string warning{};  ///< text for the user; empty if all is well
};

/// @brief Reads all fields that the formula uses, and checks that they cover the shape. Collective.
/// @throws FileError, GeometryError, ConfigError on all ranks
std::vector<BuiltField> read_fields(const RunOptions& options, const ShapeInput& input, const comm::Communicator& comm);

/// Returns the variables of the formula. They share the fields.
std::vector<FormulaField> functions_of(const std::vector<BuiltField>& fields);

/// Returns a section with a hash of each field for the config in a checkpoint, so that a restart with other data is
/// refused.
std::string hashes_of(const std::vector<BuiltField>& fields);

/// Returns the bytes of all values, which each rank holds.
std::size_t bytes_of(const std::vector<BuiltField>& fields);

/// Returns the size of the field for the log.
std::string description_of(const BuiltField& field);

} // namespace trime::app
