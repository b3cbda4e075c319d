// SPDX-License-Identifier: BSD-3-Clause
#include "trime/facade/local_mesh.hpp"

#include "core/nearest_name.hpp"
#include "facade/names.hpp"
#include "trime/core/error.hpp"
#include "trime/handover/halo_exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace trime {

std::int32_t number_of(const std::string& name, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw ConfigError(fmt::format("the mesh has no boundary '{}'{}; known: {}", name, suggestion(name, names),
                                  fmt::join(names, ", ")));
  return static_cast<std::int32_t>(found - names.begin());
}

std::vector<Facet> LocalMesh::facets(const std::string& name) const {
  const std::int32_t part = number_of(name, names_);
  std::vector<Facet> found;
  for (std::size_t k = 0; k < arrays_.facets.size(); ++k)
    if (arrays_.facet_parts[k] == part)
      found.push_back({arrays_.facets[k][0], arrays_.facets[k][1], arrays_.facet_triangles[k], arrays_.facet_tags[k],
                       k < at(arrays_.owned_facets)});
  return found;
}

void LocalMesh::update_ghosts(std::span<double> values, int components) const {
  handover::update_ghosts(*communicator_, arrays_, values, components);
}
void LocalMesh::add_to_owners(std::span<double> values, int components) const {
  handover::add_to_owners(*communicator_, arrays_, values, components);
}

double LocalMesh::sum(double value) const {
  const std::vector<double> values = communicator_->all_gather(value);
  return std::accumulate(values.begin(), values.end(), 0.0);
}

} // namespace trime
