// SPDX-License-Identifier: BSD-3-Clause
// The faults of a contour: one message lists them, or, if they are repaired, warnings.
#pragma once

#include "trime/contours/contour.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace trime::contours {

/// Says whether a fault has an area. A repair leaves out what has none.
enum class HasArea { no, yes };

/// @brief Counts a fault, and adds it to the list if it is one of the first of its kind.
/// @param make makes the fault; called only if the list takes it
void add_fault(FaultList& faults, HasArea has_area, const std::function<Fault()>& make);

/// Appends faults to a list. It keeps their numbers, and the first ones of each kind.
void add_faults(FaultList& faults, const FaultList& more);

/// @brief Throws if the treatment does not allow the faults.
/// @throws GeometryError `source:line: ...` for one fault; for several ones a text of several lines
void check_faults(const FaultList& faults, const std::string& source, Faults treatment);

/// @brief Throws as check_faults does if the caller of a reader wants errors, or if no ring is left.
/// @param expected what the file should contain; used in the message
/// @throws GeometryError if the contour has no ring, or has faults with Faults::refuse
void check_reading(const Contour& contour, Faults treatment, const char* expected);

/// Appends a warning for each of the first faults, which are repaired, and one for the number of all others.
void tell_repaired(const FaultList& faults, const std::string& source, std::vector<std::string>& warnings);

} // namespace trime::contours
