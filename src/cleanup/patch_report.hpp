// SPDX-License-Identifier: BSD-3-Clause
// Reports the sites of a patch after it was tried.
#pragma once

#include "cleanup/patch_rests.hpp"
#include "cleanup/patch_start.hpp"

#include <vector>

namespace trime::cleanup {

/// @brief Compares a patch with what it was at its start.
class PatchReport {
public:
  /// References must outlive the object.
  PatchReport(const PatchStart& start, const PatchRests& rests) : start_(start), rests_(rests) {}

  /// The difference between the sites and what they have become. @param patch see PatchOptimizer::improve
  std::vector<SiteEdit> edits(const Patch& now, std::uint64_t patch) const;
  /// Which sites on the boundary have other next ones than before, or another place.
  std::vector<BoundaryLink> links(const Patch& now, std::uint64_t patch) const;
  /// Reports all sites with triangles that are all known, if the patch has changed anything about them.
  std::vector<SiteVerdict> verdicts(const Patch& now, double bad_alpha);

private:
  static void find_worst(const Patch& patch, double bad_alpha, std::vector<double>& worst);
  bool is_news(const Patch& now, LocalIndex v) const;
  bool is_new(LocalIndex v) const { return v >= start_.vertices(); }
  BoundaryName site_before(const Patch& now, LocalIndex v) const;
  BoundaryName name(const Patch& now, LocalIndex v, std::uint64_t patch) const;

  const PatchStart& start_;
  const PatchRests& rests_;
  std::vector<double> worst_before_, worst_after_; // by vertex: alpha of its worst triangle if that is bad, else 0
};

} // namespace trime::cleanup
