// SPDX-License-Identifier: BSD-3-Clause
// The rules by which models of coasts and oceans judge a mesh, as one table. It does not measure meshes.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace trime::acceptance {

/// The models whose rules are known.
enum class Solver { adcirc, schism, telemac, fvcom, delft3d, mpas };

/// Says what a rule limits. All values are at least 0.
enum class Measure {
  least_angle,         ///< smallest angle of a triangle [degrees]
  largest_angle,       ///< largest angle of a triangle [degrees]
  skewness,            ///< longest side of a triangle over the radius of the circle that has its area
  boundary_edges,      ///< sides of a triangle that are boundary edges
  boundary_corners,    ///< corners of a triangle that lie on the boundary
  boundary_marks,      ///< sum over the corners of a triangle: 2 on an open boundary, 1 on land, 0 inside
  triangles_at_point,  ///< triangles around a point
  cell_edges,          ///< edges of the whole Voronoi cell of a point inside: the triangles around it
  boundary_paths,      ///< boundary edges that begin at a point: two or more where boundaries touch
  area_share,          ///< smaller over larger area of two triangles with a common side
  link_cosine,         ///< |cos| of the angle between a flow link and the side that it crosses, see flow_link()
  link_length,         ///< length of a flow link over the mean root of the two areas
  components,          ///< connected components of the mesh
  looped_open_boundary ///< outer boundary loops that are open all along
};

/// A rule of a solver: the measure must be at least, or at most, the limit.
struct SolverRule {
  Solver solver;
  Measure measure;
  bool is_least; ///< the limit is the smallest allowed value; otherwise the largest one
  double limit;
  bool refuses;                    ///< the solver stops, or computes on another mesh, where the rule is broken
  const char* breakers;            ///< what breaks the rule, in the plural
  const char* advice;              ///< what the user can do about it
  const char* advice_on_ears = ""; ///< more advice where ears break the rule and are not split
};

/// @brief Returns all rules, those of one solver next to each other. Sources:
/// * SMS: xmswiki.com, "SMS:Mesh Quality": angles from 10 to 150 degrees.
/// * OceanMesh2D (Roberts, Pringle, Westerink, Geosci. Model Dev. 12 (2019) 1847-1868), whose clean-up bounds the
///   triangles at a point and keeps one component.
/// * ADCIRC: 'Looped' or touching boundaries have no order of nodes, in fort.14 as in hgrid.gr3 (OCSMesh, issue 218).
/// * SCHISM: manual, "Mesh quality" (skewness); OCSMesh, issue 103: SCHISM stops at an open boundary that is a loop.
/// * TELEMAC: program STBTEL, subroutine SURCON, which divides triangles whose corners all lie on the boundary.
/// * FVCOM: user manual, mesh quality in SMS: angles from 30 to 130 degrees, areas that change by at most a half, at
///   most 8 triangles at a point. Subroutine TRIANGLE_GRID_EDGE stops at a triangle whose corners' marks add up to more
///   than 4, as on two open sides, or on an open side and a side on land; it marks triangles with two sides on land.
/// * Delft3D FM: D-Flow FM user manual, "Orthogonality" (0.5 stops the program, 0.01 is advised; OceanMesh2D, issue
///   265), and its key RemoveSmallLinksTrsh = 0.1: shorter links are closed.
/// * MPAS: Voronoi cells should have 5 to 7 edges, and hold their triangles' circumcentres (Ringler et al., Ocean
///   Modelling 69 (2013) 211-232).
std::span<const SolverRule> solver_rules();

/// Returns the word of a solver in configs and files.
std::string_view word_of(Solver solver);
/// Returns the solver with this word, if there is one.
std::optional<Solver> solver_of_word(std::string_view word);
/// Returns the words of all solvers, separated by blanks.
const char* solver_words();
/// Returns the name of a measure in files.
std::string_view name_of(Measure measure);

} // namespace trime::acceptance
