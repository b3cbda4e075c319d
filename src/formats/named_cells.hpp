// SPDX-License-Identifier: BSD-3-Clause
// Writes the table of the cells along named lines, for conditions of flow models: which cells lie at a part of the
// boundary or on a curve, and how much of it lies in each.
#pragma once

#include "formats/flow_cells.hpp"

#include <functional>
#include <string>

namespace trime::formats {

/// @brief Plans a table with a line `label,"name",cell,length` for each label and each cell along its edges, by label
/// and then by cell. A cell has the half of each edge that ends at its site. A triangle has a whole edge on the
/// boundary and half of one inside, so the lengths of a label add up to that of its edges.
/// @param append_cell appends what the format calls a cell, from its number, which counts from 0
/// @note Collective. Cost: O(labelled edges on this rank) memory; sparse exchanges.
FilePlan plan_named_cells(const FlowCells& cells, const std::string& path,
                          const std::function<void(GlobalId number, std::string& text)>& append_cell);

/// Appends the number of a cell, counted from 1.
void append_cell_number(GlobalId number, std::string& text);

} // namespace trime::formats
