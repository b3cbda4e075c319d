// SPDX-License-Identifier: BSD-3-Clause
#include "contours/faults.hpp"

#include "trime/core/error.hpp"

#include <algorithm>
#include <set>

namespace trime::contours {
namespace {

constexpr std::uint64_t most_listed = 10;

/// The faults that are listed: first those that have to be corrected in the file.
std::vector<Fault> listed(const FaultList& faults, bool with_repairable) {
  std::vector<Fault> list;
  std::copy_if(faults.first.begin(), faults.first.end(), std::back_inserter(list),
               [](const Fault& fault) { return fault.repaired.empty(); });
  if (with_repairable)
    std::copy_if(faults.first.begin(), faults.first.end(), std::back_inserter(list),
                 [](const Fault& fault) { return !fault.repaired.empty(); });
  list.resize(std::min<std::size_t>(list.size(), most_listed));
  return list;
}

std::string with_remedy(const Fault& fault) {
  return fault.remedy.empty() ? fault.what : fault.what + "; " + fault.remedy;
}

/// The sentence that follows the number of faults. @pre the treatment is not Faults::refuse
std::string advice(const FaultList& faults, Faults treatment) {
  if (treatment == Faults::repair)
    return " that 'repair = true' does not repair: correct them in the file";
  constexpr const char* key = "'repair = true' in the section of this contour";
  if (faults.repairable == 0)
    return ", which have to be corrected in the file";
  if (faults.others == 0)
    return fmt::format(". They have no area: try {}, which leaves them out", key);
  return fmt::format(". Try {}, which leaves out {} without area; correct the other {} in the file", key,
                     faults.repairable, faults.others);
}

[[noreturn]] void refuse(const FaultList& faults, const std::string& source, Faults treatment) {
  const std::vector<Fault> list = listed(faults, treatment != Faults::repair);
  const std::uint64_t count = faults.others + (treatment == Faults::repair ? 0 : faults.repairable);
  if (count == 1) {
    const bool can_repair = treatment == Faults::collect && faults.repairable == 1;
    throw GeometryError(fmt::format("{}: {}{}", list[0].where, with_remedy(list[0]),
                                    can_repair ? fmt::format(", or try 'repair = true' in the section of this contour: "
                                                             "{}",
                                                             list[0].repaired)
                                               : ""));
  }
  std::string text = fmt::format("{}: found {} faults{}:", source, count,
                                 treatment == Faults::refuse ? "" : advice(faults, treatment));
  std::set<std::string> remedies; // each one once
  for (const Fault& fault : list)
    text +=
        fmt::format("\n  {}: {}", fault.where, remedies.insert(fault.remedy).second ? with_remedy(fault) : fault.what);
  if (count > list.size())
    text += fmt::format("\n  and {} more", count - list.size());
  throw GeometryError(text);
}

} // namespace

void add_fault(FaultList& faults, HasArea has_area, const std::function<Fault()>& make) {
  if (++(has_area == HasArea::yes ? faults.others : faults.repairable) <= most_listed)
    faults.first.push_back(make());
}

void add_faults(FaultList& faults, const FaultList& more) {
  FaultList others = more; // those that are not listed
  for (const Fault& fault : more.first) {
    const HasArea has_area = fault.repaired.empty() ? HasArea::yes : HasArea::no;
    --(has_area == HasArea::yes ? others.others : others.repairable);
    add_fault(faults, has_area, [&] { return fault; });
  }
  faults.repairable += others.repairable;
  faults.others += others.others;
}

void check_faults(const FaultList& faults, const std::string& source, Faults treatment) {
  if (faults.others > 0 || (faults.repairable > 0 && treatment != Faults::repair))
    refuse(faults, source, treatment);
}

void check_reading(const Contour& contour, Faults treatment, const char* expected) {
  if (treatment == Faults::refuse)
    check_faults(contour.faults, contour.source, treatment);
  if (!contour.rings.empty())
    return;
  check_faults(contour.faults, contour.source, Faults::refuse); // a repair would leave nothing
  throw GeometryError(fmt::format("{}: expected {}, found no vertex at all", contour.source, expected));
}

void tell_repaired(const FaultList& faults, const std::string& source, std::vector<std::string>& warnings) {
  std::uint64_t told = 0;
  for (const Fault& fault : faults.first)
    if (!fault.repaired.empty()) {
      warnings.push_back(fmt::format("{}: {}; {}", fault.where, fault.what, fault.repaired));
      ++told;
    }
  if (told < faults.repairable)
    warnings.push_back(fmt::format("{}: {} more faults without area are repaired", source, faults.repairable - told));
}

} // namespace trime::contours
