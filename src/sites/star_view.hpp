// SPDX-License-Identifier: BSD-3-Clause
// The certified stars of a rank with h at their sites, for code that moves sites or measures triangles.
#pragma once

#include "delaunay/star_table.hpp"
#include "mesh/binned_points.hpp"
#include "mesh/local_sizes.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::sites {

/// Certified stars around the inner sites, and h.
class StarView {
public:
  /// @param sizes h at the sites, as far as it is known; if null, h is evaluated
  StarView(const mesh::BinnedPoints& all_points, const delaunay::StarTable& all_stars, const sizing::SizeField& field,
           const mesh::LocalSizes* sizes = nullptr)
      : points(all_points), stars(all_stars), size_(field), sizes_(sizes), is_uniform_(field.is_uniform()),
        uniform_size_(is_uniform_ ? field.size({}) : 0) {}

  bool is_uniform() const { return is_uniform_; }
  /// Returns h at any point, or at an image of a point.
  double size(geometry::Vec2 p) const {
    return is_uniform_ ? uniform_size_ : size_.size(points.grid().periods().wrap(p));
  }
  /// Returns h at site i, owned or ghost. It has the same bits as size(points.position(i)), but is looked up where it
  /// is known.
  double size(LocalIndex i) const { return sizes_ && sizes_->known(i) ? (*sizes_)[i] : size(points.position(i)); }

  const mesh::BinnedPoints& points;
  const delaunay::StarTable& stars;

private:
  const sizing::SizeField& size_;
  const mesh::LocalSizes* sizes_;
  bool is_uniform_;
  double uniform_size_;
};

} // namespace trime::sites
