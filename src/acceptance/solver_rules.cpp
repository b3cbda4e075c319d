// SPDX-License-Identifier: BSD-3-Clause
#include "acceptance/solver_rules.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace trime::acceptance {
namespace {

// Limits of SMS for any triangle mesh [degrees].
constexpr double sms_least_angle = 10, sms_largest_angle = 150;
// Limits of FVCOM's manual [degrees], [1], [triangles].
constexpr double fvcom_least_angle = 30, fvcom_largest_angle = 130, fvcom_area_share = 0.5, fvcom_most_triangles = 8;
// [1] FVCOM stops above it, see Measure::boundary_marks.
constexpr double fvcom_most_marks = 4;
// [triangles] ADCIRC was long built with room for 10 entries for a point and its neighbours.
constexpr double adcirc_most_triangles = 9;
// [1] SCHISM's manual has no trouble up to here.
constexpr double schism_skewness = 15;
// [1] D-Flow FM stops at the first cosine, and advises the second one.
constexpr double delft3d_stop_cosine = 0.5, delft3d_good_cosine = 0.01;
// [1] D-Flow FM closes shorter links (RemoveSmallLinksTrsh).
constexpr double delft3d_link_length = 0.1;
// [1] Sizes of neighbours that differ by at most 1.4, as its manual advises for smooth grids, so areas by 1.4^2.
constexpr double delft3d_area_share = 0.51;
// [edges] Cells of good Voronoi meshes have 5 to 7; MPAS interpolates badly from squares.
constexpr double mpas_least_edges = 5, mpas_most_edges = 7;
// [degrees] Beyond it the circumcentre lies outside of its triangle, and edges of the two meshes may not cross.
constexpr double right_angle = 90;

constexpr const char* finer = "use smaller triangles or a smoother size there";
constexpr const char* gentler = "use a smaller gradation in [sizing]";
constexpr const char* corner = "cut the corner off, or make it wider";
constexpr const char* narrow = "use smaller triangles in narrow channels";
constexpr const char* split =
    "; split_ears = true in [meshing] divides those with two boundary edges in corners of 60 degrees or more";
constexpr const char* open_end = "let the open boundary meet the land at a right angle, or use smaller triangles there";
constexpr const char* untouched = "move the boundaries apart";

constexpr SolverRule table[] = {
    {Solver::adcirc, Measure::least_angle, true, sms_least_angle, false, "triangles", finer},
    {Solver::adcirc, Measure::largest_angle, false, sms_largest_angle, false, "triangles", finer},
    {Solver::adcirc, Measure::triangles_at_point, false, adcirc_most_triangles, false, "points", gentler},
    {Solver::adcirc, Measure::boundary_paths, false, 1, true, "points", untouched},
    {Solver::adcirc, Measure::components, false, 1, false, "components", "set components = largest in [meshing]"},
    {Solver::schism, Measure::skewness, false, schism_skewness, false, "triangles", finer},
    {Solver::schism, Measure::boundary_edges, false, 2, true, "triangles", "set components = largest in [meshing]"},
    {Solver::schism, Measure::boundary_paths, false, 1, true, "points", untouched},
    {Solver::schism, Measure::looped_open_boundary, false, 0, true, "loops",
     "give a part of the boundary a name that open_boundary in [output] does not have"},
    {Solver::telemac, Measure::boundary_corners, false, 2, false, "triangles", narrow, split},
    {Solver::telemac, Measure::boundary_paths, false, 1, true, "points", untouched},
    {Solver::fvcom, Measure::least_angle, true, fvcom_least_angle, false, "triangles", finer},
    {Solver::fvcom, Measure::largest_angle, false, fvcom_largest_angle, false, "triangles", finer},
    {Solver::fvcom, Measure::area_share, true, fvcom_area_share, false, "pairs of triangles", gentler},
    {Solver::fvcom, Measure::triangles_at_point, false, fvcom_most_triangles, false, "points", gentler},
    {Solver::fvcom, Measure::boundary_edges, false, 1, false, "triangles", corner, split},
    {Solver::fvcom, Measure::boundary_marks, false, fvcom_most_marks, true, "triangles", open_end},
    {Solver::fvcom, Measure::boundary_paths, false, 1, true, "points", untouched},
    {Solver::delft3d, Measure::link_cosine, false, delft3d_stop_cosine, true, "links", finer},
    {Solver::delft3d, Measure::link_cosine, false, delft3d_good_cosine, false, "links", finer},
    {Solver::delft3d, Measure::link_length, true, delft3d_link_length, false, "links", finer},
    {Solver::delft3d, Measure::area_share, true, delft3d_area_share, false, "pairs of triangles", gentler},
    {Solver::mpas, Measure::largest_angle, false, right_angle, false, "triangles", finer},
    {Solver::mpas, Measure::cell_edges, true, mpas_least_edges, false, "points", gentler},
    {Solver::mpas, Measure::cell_edges, false, mpas_most_edges, false, "points", gentler},
};

constexpr std::array<std::string_view, 6> words{"adcirc", "schism", "telemac", "fvcom", "delft3d", "mpas"};

} // namespace

std::span<const SolverRule> solver_rules() {
  return table;
}

std::string_view word_of(Solver solver) {
  return words.at(static_cast<std::size_t>(solver));
}

std::optional<Solver> solver_of_word(std::string_view word) {
  const auto found = std::ranges::find(words, word);
  return found == words.end() ? std::nullopt : std::optional(static_cast<Solver>(found - words.begin()));
}

const char* solver_words() {
  static const std::string text = [] {
    std::string all;
    for (const std::string_view word : words)
      all.append(all.empty() ? "" : " ").append(word);
    return all;
  }();
  return text.c_str();
}

std::string_view name_of(Measure measure) {
  constexpr std::string_view names[] = {
      "least_angle",    "largest_angle",      "skewness",   "boundary_edges",      "boundary_corners",
      "boundary_marks", "triangles_at_point", "cell_edges", "boundary_paths",      "area_share",
      "link_cosine",    "link_length",        "components", "looped_open_boundary"};
  return names[static_cast<std::size_t>(measure)];
}

} // namespace trime::acceptance
