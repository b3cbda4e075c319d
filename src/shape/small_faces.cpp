// SPDX-License-Identifier: BSD-3-Clause
#include "shape/small_faces.hpp"

#include "geometry/piece_parts.hpp"

#include "core/angle.hpp"
#include "shape/boundary_area.hpp"
#include "shape/inner_curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace trime::shape {
namespace {

using geometry::AbsorbedFaces;
using geometry::LossReason;
using geometry::Piece;
using geometry::RegionLoss;
using geometry::Vec2;

// Each round gives away at least the smallest face, and usually nearly all.
constexpr int most_rounds = 100;

/// One side of a piece: 2 k is the left side of piece k, along it; 2 k + 1 the right side, against it.
using Side = std::size_t;

/// The faces of the division as walks along their borders; a face with holes has several. A curve with one region on
/// both sides divides no face: the walks along both of its sides are one.
class Faces {
public:
  explicit Faces(const std::vector<LabelledPiece>& pieces) : pieces_(pieces) {
    link();
    walk();
    unite_walks();
  }

  struct Walk {
    std::vector<Side> firsts;       ///< one side of each of the walks
    double area = 0, perimeter = 0; ///< the area is negative around a hole
  };
  const std::vector<Walk>& walks() const { return walks_; }

  template <class Visit>
  void for_each_side(const Walk& walk, const Visit& visit) const {
    for (const Side first : walk.firsts) {
      Side side = first;
      do {
        visit(side);
        side = next_[side];
      } while (side != first);
    }
  }
  int label(Side side) const {
    const LabelledPiece& piece = pieces_[side / 2];
    return side % 2 == 0 ? piece.left : piece.right;
  }

  /// Does the side belong to a curve inside a face?
  bool is_inside(Side side) const { return pieces_[side / 2].left == pieces_[side / 2].right; }

private:
  LocalIndex start(Side side) const { return side % 2 == 0 ? pieces_[side / 2].from : pieces_[side / 2].to; }
  Piece along(Side side) const { return side % 2 == 0 ? pieces_[side / 2].piece : reversed(pieces_[side / 2].piece); }

  /// Whoever arrives at a vertex leaves along the next piece clockwise.
  void link() {
    struct Arm {
      LocalIndex vertex;
      double angle, curvature;
      Side out;
    };
    std::vector<Arm> arms;
    for (Side side = 0; side < 2 * pieces_.size(); ++side) {
      const Piece piece = along(side);
      const Vec2 direction = piece.tangent(0);
      arms.push_back({start(side), angle_of(direction.y, direction.x),
                      piece.circular ? (piece.sweep > 0 ? 1 : -1) / piece.radius : 0, side});
    }
    std::sort(arms.begin(), arms.end(), [](const Arm& a, const Arm& b) {
      return std::tie(a.vertex, a.angle, a.curvature, a.out) < std::tie(b.vertex, b.angle, b.curvature, b.out);
    });
    next_.resize(arms.size());
    for (std::size_t begin = 0, end = 0; begin < arms.size(); begin = end) {
      while (end < arms.size() && arms[end].vertex == arms[begin].vertex)
        ++end;
      for (std::size_t k = begin; k < end; ++k)
        next_[arms[k].out ^ 1] = arms[k > begin ? k - 1 : end - 1].out;
    }
  }

  void walk() {
    std::vector<char> is_seen(next_.size(), 0);
    for (Side first = 0; first < next_.size(); ++first) {
      if (is_seen[first] != 0)
        continue;
      Walk found{{first}};
      const Vec2 origin = along(first).start;
      for_each_side(found, [&](Side side) {
        is_seen[side] = 1;
        const Piece piece = along(side);
        found.area += 0.5 * twice_area_under({piece}, origin);
        found.perimeter += is_inside(side) ? 0 : piece.length();
      });
      walks_.push_back(std::move(found));
    }
  }

  /// Makes one walk of those along the two sides of curves inside a face, in the place of the first one.
  void unite_walks() {
    std::vector<std::size_t> walk_of(next_.size()), root;
    for (std::size_t k = 0; k < walks_.size(); ++k) {
      root.push_back(k);
      for_each_side(walks_[k], [&](Side side) { walk_of[side] = k; });
    }
    const auto root_of = [&root](std::size_t k) {
      while (root[k] != k)
        k = root[k] = root[root[k]];
      return k;
    };
    for (Side side = 0; side < next_.size(); side += 2)
      if (is_inside(side)) {
        const auto [low, high] = std::minmax({root_of(walk_of[side]), root_of(walk_of[side + 1])});
        root[high] = low;
      }
    std::size_t left = 0;
    std::vector<std::size_t> place(walks_.size());
    for (std::size_t k = 0; k < walks_.size(); ++k) {
      if (const std::size_t other = root_of(k); other != k) {
        Walk& whole = walks_[place[other]];
        whole.firsts.push_back(walks_[k].firsts[0]);
        whole.area += walks_[k].area;
        whole.perimeter += walks_[k].perimeter;
        continue;
      }
      place[k] = left;
      if (left != k)
        walks_[left] = std::move(walks_[k]);
      ++left;
    }
    walks_.resize(left);
  }

  const std::vector<LabelledPiece>& pieces_;
  std::vector<Side> next_; // by side: the side that follows it around the face
  std::vector<Walk> walks_;
};

/// Returns the label across the longest part of the border without a curve, the lowest one of equally long parts; -1 if
/// there is only the outside.
int widest_neighbour(const Faces& faces, const Faces::Walk& walk, const std::vector<LabelledPiece>& pieces) {
  std::map<int, double> lengths;
  faces.for_each_side(walk, [&](Side side) {
    if (!pieces[side / 2].on_curve)
      lengths[faces.label(side ^ 1)] += pieces[side / 2].piece.length();
  });
  int best = -1;
  double longest = 0;
  for (const auto& [label, length] : lengths)
    if (label >= 0 && length > longest) {
      longest = length;
      best = label;
    }
  return best;
}

/// Gives away the smallest faces, as long as none is next to another one of this round.
bool absorb_once(std::vector<LabelledPiece>& pieces, const LeastFace& least, AbsorbedFaces& absorbed) {
  const Faces faces(pieces);
  std::vector<Faces::Walk> small;
  for (const Faces::Walk& walk : faces.walks())
    if (faces.label(walk.firsts[0]) >= 0 && walk.area > 0 &&
        (walk.perimeter < least.perimeter ||
         2 * walk.area < (faces.label(walk.firsts[0]) == 0 ? least.gap : least.width) * walk.perimeter))
      small.push_back(walk);
  std::sort(small.begin(), small.end(), [](const Faces::Walk& a, const Faces::Walk& b) {
    return std::tie(a.area, a.firsts[0]) < std::tie(b.area, b.firsts[0]);
  });
  std::vector<char> is_changed(pieces.size(), 0);
  std::vector<std::pair<Side, int>> labels; // to be set
  for (const Faces::Walk& walk : small) {
    bool is_free = true;
    faces.for_each_side(walk, [&](Side side) { is_free = is_free && is_changed[side / 2] == 0; });
    const int label = is_free ? widest_neighbour(faces, walk, pieces) : -1;
    if (label < 0)
      continue;
    faces.for_each_side(walk, [&](Side side) {
      is_changed[side / 2] = 1;
      labels.emplace_back(side, label);
    });
    absorbed.faces.push_back({faces.label(walk.firsts[0]), label,
                              walk.perimeter < least.perimeter ? LossReason::crumb : LossReason::sliver, walk.area, 1,
                              walk.area, pieces[walk.firsts[0] / 2].piece.start});
  }
  for (const auto& [side, label] : labels)
    (side % 2 == 0 ? pieces[side / 2].left : pieces[side / 2].right) = label;
  std::erase_if(pieces, [](const LabelledPiece& piece) { return piece.left == piece.right && !piece.on_curve; });
  return !labels.empty();
}

} // namespace

AbsorbedFaces absorb_small_faces(std::vector<LabelledPiece>& pieces, const LeastFace& least) {
  AbsorbedFaces absorbed;
  for (int round = 0; round < most_rounds; ++round)
    if (!absorb_once(pieces, least, absorbed))
      break;
  for (const RegionLoss& loss : absorbed.faces) {
    ++absorbed.count;
    absorbed.area += loss.area;
    if (loss.area > absorbed.largest) {
      absorbed.largest = loss.area;
      absorbed.place = loss.place;
    }
  }
  return absorbed;
}

} // namespace trime::shape
