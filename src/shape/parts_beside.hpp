// SPDX-License-Identifier: BSD-3-Clause
// Collects which parts lie on which side of a piece of an arrangement.
#pragma once

#include <cstddef>
#include <vector>

namespace trime::shape {

/// The placed parts on the left and on the right of one piece after the other.
class PartsBeside {
public:
  explicit PartsBeside(std::size_t parts) : piece_of_(parts, 0), is_left_(parts, 0) {}

  void begin() {
    ++piece_;
    for (std::vector<int>* parts : {&known_, &left_, &right_})
      parts->clear();
  }
  /// Notes that a curve of the part runs along the piece. Of several calls for a part, the last one counts.
  void set(int part, bool on_left) {
    if (!has(static_cast<std::size_t>(part)))
      known_.push_back(part);
    piece_of_[static_cast<std::size_t>(part)] = piece_;
    is_left_[static_cast<std::size_t>(part)] = on_left ? 1 : 0;
  }
  bool has(std::size_t part) const { return piece_of_[part] == piece_; }
  /// Makes the lists. @pre all parts whose curves run along the piece are set
  void divide() {
    for (const int part : known_)
      (is_left_[static_cast<std::size_t>(part)] != 0 ? left_ : right_).push_back(part);
  }
  void add_on_both(int part) {
    left_.push_back(part);
    right_.push_back(part);
  }
  const std::vector<int>& left() const { return left_; }
  const std::vector<int>& right() const { return right_; }

private:
  std::size_t piece_ = 0;             // number of the present one, from 1
  std::vector<std::size_t> piece_of_; // the last one for which each part was set
  std::vector<char> is_left_;
  std::vector<int> known_, left_, right_;
};

} // namespace trime::shape
