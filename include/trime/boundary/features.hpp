// SPDX-License-Identifier: BSD-3-Clause
// Features of the boundary that are smaller than the triangles: the options say which of them the mesh keeps, and the
// report says what a run did to them and to each loop of the given boundary. Plain data.
#pragma once

#include "trime/core/error.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trime::boundary {

/// How the mesher treats parts of the outside that are narrower than the triangles: slits, cracks, walls.
enum class NarrowOutside {
  keep,  ///< moves the two sides apart where they are nearer to each other than a third of the local size
  close, ///< fills the narrow part, so that it belongs to the shape
};

/// Says what the mesher does with narrow parts of the shape, or of the outside, that join or separate bodies larger
/// than the triangles.
enum class Connections {
  keep, ///< keeps the connection: lowers the size there, and widens what is narrower than 0.35 of the local size
  cut,  ///< cuts the connection like a dead end, and warns
};

/// Which components of the simplified shape are meshed.
enum class Components {
  all,
  largest, ///< the component with the largest area
  at,      ///< the component that contains FeatureOptions::component_place
};

/// Which corners, islands, lakes and narrow parts of the shape the mesh keeps.
struct FeatureOptions {
  double corner_angle = 30;  ///< degrees: a boundary vertex that turns by more than this angle is a corner
  bool keep_all = false;     ///< keeps every corner, island, lake and narrow part, however small
  bool refine_narrow = true; ///< lowers a uniform size where the shape is narrower than the triangles
  double tolerance =
      0.1; ///< in local sizes: largest distance from a boundary edge of the mesh to a corner that it leaves out
  double within = 0.5; ///< in local sizes: largest distance from a simplified curve to the given one
  Connections connect = Connections::keep;
  Components components = Components::all;
  geometry::Vec2 component_place; ///< for Components::at
  std::optional<double>
      max_loss; ///< largest share of the area that may be lost; if more is lost, the mesh counts as incomplete
  NarrowOutside narrow = NarrowOutside::keep; ///< treatment of narrow gaps; gaps next to components with a perimeter
                                              ///< below 5 h are always closed
};

/// A loop of the given shape, and the loops of the mesh that follow it.
struct LoopFate {
  enum class State {
    kept,       ///< the curve is unchanged, bit for bit; boundary edges may still leave corners out, see
                ///< FeatureOptions::tolerance
    simplified, ///< one loop of the mesh follows this loop and no other
    split,      ///< several loops of the mesh follow this loop
    merged,  ///< a loop of the mesh follows this loop and others, or a larger part of the shape covers the area inside
             ///< it
    dropped, ///< the loop is missing in the mesh, and so is the part of the shape inside it
    filled,  ///< a hole that now belongs to the shape
    left_out ///< a loop of a component that is left out because FeatureOptions::components asks for another component
  };
  State state = State::kept;
  std::vector<std::int32_t>
      tags; ///< tags of the mesh loops that follow this loop; first the one that follows the largest part of it
  geometry::Vec2 place;  ///< first vertex of the loop
  std::int32_t part = 0; ///< part of the shape to which its first piece belongs, as an index into Boundary::part_names
  double area = 0;       ///< area inside the loop; 0 for a loop around a periodic container
  double length = 0;
  double remaining_length = 0; ///< length of the mesh curves that follow the loop, at most `length`
  double largest_deviation =
      0; ///< largest distance of these mesh curves from the given boundary, divided by the size that was asked for
  double mesh_area = 0;   ///< area that the mesh loops enclose, with straight edges; 0 for a band or if is_lost()
  double mesh_length = 0; ///< sum of the lengths of their edges; 0 in the same cases
  double deviation = 0;   ///< largest distance between these edges and the given boundary, a length
  double reach = 0;       ///< largest distance of a vertex of the loop from the mesh curves; 0 if the loop is kept
  double extent = 0;      ///< diagonal of the box around the loop

  bool is_lost() const { return state == State::merged || state == State::dropped || state == State::filled; }
};

/// Returns "kept", "simplified", ...
const char* to_string(LoopFate::State state);

/// The loops that differ noticeably from the shape, each compared with its own size. Loops that are lost do not count.
struct ChangedBodies {
  GlobalId number = 0;
  std::size_t worst = 0; ///< index into FeatureReport::loops, if there is one
  double perimeter = 0;  ///< length of that loop divided by the size that was asked for there
};

/// A corner of the boundary polygon and its interior angle.
struct SharpCorner {
  geometry::Vec2 place;
  double degrees;
};

/// How the last stage of a run simplified features of the boundary that are smaller than the triangles.
struct FeatureReport {
  static constexpr double sharp_angle = 56; ///< degrees; a corner with a smaller angle cannot have a good triangle
  GlobalId dropped_islands = 0, dropped_lakes = 0;
  double dropped_area = 0;       ///< area of the dropped islands and lakes
  double dropped_share = 0;      ///< dropped_area divided by the area of the given shape
  GlobalId corners_left_out = 0; ///< corners of the kept loops that are not vertices of the mesh
  double largest_deviation =
      0; ///< largest distance of a left-out corner from its boundary edge, divided by the local size
  GlobalId segments_halved = 0; ///< boundary edges that were halved to keep their diametral circles free of sites
  GlobalId size_limits = 0;     ///< places where the size was lowered
  double lowest_size_share = 1; ///< smallest ratio of the lowered size to the size that was asked for
  std::vector<SharpCorner> sharp_corners; ///< corners with an angle below sharp_angle, the sharpest first
  GlobalId cut = 0;                       ///< narrow parts of the shape that were cut off before points were placed
  GlobalId
      closed = 0,
      widened =
          0; ///< narrow parts of the outside: closed ones were filled, and the sides of widened ones were moved apart
  GlobalId severed =
      0; ///< narrow parts that joined or separated large parts of the shape, and were nevertheless cut or closed
  double widest_severed = 0;     ///< largest width among the severed parts, divided by the size there
  geometry::Vec2 severed_place;  ///< place of the widest severed part
  GlobalId held = 0;             ///< narrow parts that were kept because they join or separate large parts of the shape
  GlobalId filled = 0;           ///< holes that were filled because they are smaller than a triangle
  GlobalId smoothed = 0;         ///< vertices of ragged curves that smoothing replaced
  GlobalId thinned = 0;          ///< pieces of ragged curves that thinning replaced
  double coarseness = 1;         ///< size h for which the boundary was simplified, divided by the h of the mesh
  GlobalId other_components = 0; ///< components that were left out because the user asked for one component
  double other_share = 0;        ///< area of the components that were left out, divided by the area of the shape
  double lost_share = 0,
         added_share = 0;      ///< areas divided by the area of the shape, including dropped islands and lakes
  double given_area = 0;       ///< area of the given shape
  std::vector<LoopFate> loops; ///< fate of each loop of the shape, in the order of the loops
  int given_components = 0, given_holes = 0; ///< numbers of components and holes of the given shape
  int components = 0, holes = 0; ///< numbers of components and holes of the simplified shape, which is meshed
  geometry::Vec2 lost_place;     ///< first vertex of the longest lost loop
  double lost_perimeter = 0;     ///< length of the longest lost loop divided by the size there
  ChangedBodies changed;         ///< loops that stay, but not as they were
  bool absolute_sizes = false; ///< true if the user gave sizes as lengths, and not a number of points or a mean length
  double hole_share = 0; ///< area that the mesh gains since edges are chords of holes, divided by that of the shape
};

/// Returns one line of text for each kind of change to the boundary; no lines if the boundary was kept as it is.
std::vector<PlacedText> describe(const FeatureReport& report);

/// Returns whether the mesh has other numbers of components or holes than the given shape, or a loop was lost or split.
bool changes_topology(const FeatureReport& report);

/// Says whether a report is about a mesh that is written, or about one that a run would make.
enum class Occasion { run, outlook };

/// Returns a warning that says which parts of the shape are missing in the mesh, and what the user can do. If the
/// number of components or holes has changed, the warning begins with it, its reason and a place. The text is empty if
/// no loop is lost or split, the numbers of components and holes are those of the shape, and at most 0.1 % of the area
/// is lost or added.
PlacedText loss_warning(const FeatureReport& report, Occasion occasion = Occasion::run);

/// Returns a warning that names the loop that has changed most in comparison with its own area, width and extent. It is
/// empty if every loop that stays keeps its area within 2 %, and lies within a tenth of its width and a twentieth of
/// its extent of the shape. The chords of all holes together may add 0.1 % to the area of the shape.
/// @param part_names Boundary::part_names of the shape
PlacedText body_warning(const FeatureReport& report, const std::vector<std::string>& part_names,
                        Occasion occasion = Occasion::run);

} // namespace trime::boundary
