// SPDX-License-Identifier: BSD-3-Clause
// Features of the boundary that are smaller than the triangles: which of them the mesh keeps (options), and what a run
// did to them and to each loop of the given boundary (result). Plain data.
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
  keep,  ///< moves their sides apart where these are nearer than a third of the local size
  close, ///< makes them a part of the shape
};

/// Says what the mesher does with narrow parts of the shape, or of the outside, that join or separate bodies larger
/// than the triangles.
enum class Connections {
  keep, ///< the size is lowered there, and parts that are narrower than 0.35 of it are widened
  cut,  ///< they are cut like dead ends, and a warning says so
};

/// Says which components of the simplified shape are meshed.
enum class Components {
  all,
  largest, ///< the one with the largest area
  at,      ///< the one that holds a place
};

/// Which corners, islands, lakes and narrow parts of the shape the mesh keeps.
struct FeatureOptions {
  double corner_angle = 30;  ///< degrees: a vertex of the boundary that turns by more is a corner
  bool keep_all = false;     ///< keeps every corner, island, lake and narrow part, however small
  bool refine_narrow = true; ///< lowers a uniform size where the shape is narrower than the triangles
  double tolerance = 0.1;    ///< in local sizes: how far chords may pass from corners that they leave out
  double within = 0.5;       ///< in local sizes: how far simplified curves may lie from the given ones
  Connections connect = Connections::keep;
  Components components = Components::all;
  geometry::Vec2 component_place; ///< for Components::at
  std::optional<double> max_loss; ///< share of the area: if more is lost, the mesh counts as incomplete
  NarrowOutside narrow =
      NarrowOutside::keep; ///< narrow gaps next to components with a perimeter below 5 h are always closed
};

/// A loop of the shape and the loops of the mesh that follow it.
struct LoopFate {
  enum class State {
    kept, ///< the curve is unchanged, bit for bit; chords may still leave corners out, see FeatureOptions::tolerance
    simplified, ///< one loop of the mesh follows it and no other
    split,      ///< several loops of the mesh follow it
    merged,     ///< a loop of the mesh follows it and others, or a larger part of the shape covers what it enclosed
    dropped,    ///< the loop and the part of the shape in it are gone
    filled,     ///< a hole that now belongs to the shape
    left_out    ///< of a component that is left out since FeatureOptions::components asks for another one
  };
  State state = State::kept;
  std::vector<std::int32_t>
      tags;              ///< tags of the mesh loops that follow it, beginning with the one that follows most of it
  geometry::Vec2 place;  ///< its first vertex
  std::int32_t part = 0; ///< part of its first piece, as an index into Boundary::part_names
  double area = 0;       ///< area that it encloses; 0 for a band
  double length = 0;
  double remaining_length = 0; ///< length of the mesh curves that follow it, at most `length`
  double largest_deviation =
      0;                  ///< distance of these curves from the given boundary, divided by the size that was asked for
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

/// A corner of the boundary polygon and its angle on the inside.
struct SharpCorner {
  geometry::Vec2 place;
  double degrees;
};

/// How the last stage simplified features of the boundary that are smaller than the triangles.
struct FeatureReport {
  static constexpr double sharp_angle = 56; ///< degrees; below, a good triangle does not fit in a corner
  GlobalId dropped_islands = 0, dropped_lakes = 0;
  double dropped_area = 0;                ///< the area of both
  double dropped_share = 0;               ///< that area divided by the area of the given shape
  GlobalId corners_left_out = 0;          ///< on the loops that were kept
  double largest_deviation = 0;           ///< distance of one of them from its facet, divided by the local size
  GlobalId segments_halved = 0;           ///< halved after the layout, to keep their diametral circles empty
  GlobalId size_limits = 0;               ///< places where the size was lowered
  double lowest_size_share = 1;           ///< smallest size at these places, divided by the size that was asked for
  std::vector<SharpCorner> sharp_corners; ///< below sharp_angle, the sharpest first
  GlobalId cut = 0;                       ///< narrow parts of the shape that were cut off before the layout
  GlobalId closed = 0,
           widened = 0;      ///< narrow parts of the outside: those that were filled, and those with sides moved apart
  GlobalId severed = 0;      ///< narrow parts that joined or separated what stays, and were cut or closed
  double widest_severed = 0; ///< the least width of the widest of these, divided by the size
  geometry::Vec2 severed_place;  ///< where that is
  GlobalId held = 0;             ///< narrow parts that were kept since they join or separate what stays
  GlobalId filled = 0;           ///< holes around which no triangle fits
  GlobalId smoothed = 0;         ///< vertices of ragged curves that smoothing replaced
  GlobalId thinned = 0;          ///< pieces of ragged curves that thinning replaced
  double coarseness = 1;         ///< the h for which the boundary was simplified, divided by the h of the mesh
  GlobalId other_components = 0; ///< left out since one component was asked for
  double other_share = 0;        ///< their area divided by that of the shape
  double lost_share = 0,
         added_share = 0;      ///< areas divided by the area of the shape, including dropped islands and lakes
  double given_area = 0;       ///< area of the given shape
  std::vector<LoopFate> loops; ///< one for each loop of the shape, in their order
  int given_components = 0, given_holes = 0; ///< number for the given shape
  int components = 0, holes = 0;             ///< number for the simplified shape, which the mesh has
  geometry::Vec2 lost_place;                 ///< first vertex of the longest loop that is lost
  double lost_perimeter = 0;                 ///< its length divided by the size there
  ChangedBodies changed;                     ///< loops that stay, but not as they were
  double hole_share = 0; ///< area that the mesh gains since edges are chords of holes, divided by that of the shape
};

/// Returns one line of text for each kind of change; no lines for a boundary that was kept as it is.
std::vector<PlacedText> describe(const FeatureReport& report);

/// Returns whether components or holes of the mesh differ from those of the given shape, or a loop was lost or split.
bool changes_topology(const FeatureReport& report);

/// Says whether a report is about a mesh that is written, or about one that a run would make.
enum class Occasion { run, outlook };

/// Returns a warning that says what of the shape is missing in the mesh, and what the user can do. Numbers of
/// components and holes that have changed come first, with the reason and a place. It is empty if no loop is lost or
/// split, the numbers of components and holes are those of the shape, and at most 0.1 % of the area is lost or added.
PlacedText loss_warning(const FeatureReport& report, Occasion occasion = Occasion::run);

/// Returns a warning that names the loop that has changed most in comparison with its own area, width and extent. It is
/// empty if every loop that stays keeps its area within 2 %, and lies within a tenth of its width and a twentieth of
/// its extent of the shape. The chords of all holes together may add 0.1 % to the area of the shape.
/// @param part_names Boundary::part_names of the shape
PlacedText body_warning(const FeatureReport& report, const std::vector<std::string>& part_names,
                        Occasion occasion = Occasion::run);

} // namespace trime::boundary
