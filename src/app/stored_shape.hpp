// SPDX-License-Identifier: BSD-3-Clause
// Makes the shape of a mesh again, from the config that its file stores.
#pragma once

#include "app/shape_builder.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/io/metadata.hpp"

#include <optional>
#include <string>

namespace trime::app {

/// The shape of a mesh file. If it cannot be made, `input` is empty, and `reason` says why.
struct StoredShape {
  std::optional<ShapeInput> input{};
  std::optional<geometry::Boundary>
      simplified{}; ///< the curves that the mesh follows, if they are not those of the shape
  std::string reason{};
  bool vtkhdf = true, xdmf = true; ///< the views that the config asks for
  bool cells = false;              ///< the config asks for Voronoi cells in the mesh file

  /// Returns the curves that the mesh follows, or null.
  const geometry::Boundary* curves() const { return simplified ? &*simplified : input ? &input->boundary() : nullptr; }
};

/// @brief Makes the shape from the config in the metadata of a mesh file, and the contour files that this config names.
/// There is no shape if the file has no config, if a contour file cannot be read, or if the shape is no longer the one
/// that was meshed. The function compares the area, the names of the parts and the periods.
/// If the mesh follows a simplified boundary, the boundary is simplified again, as in the run.
/// @param metadata with the groups `tags` and `rings` @param path of the mesh file, for messages
/// @note Collective. All ranks get the same.
StoredShape stored_shape(const io::Metadata& metadata, const std::string& path, const comm::Communicator& comm);

} // namespace trime::app
