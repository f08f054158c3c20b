#pragma once

#include <compare>
#include <span>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Sets of faces whose corners lie at the same places, as of two-sided hair cards. Nothing may be welded that would
/// make them share vertices they do not share in the file.
class CoincidentFaces {
 public:
  /// One face of a set, at one of its vertices.
  struct Corner {
    Index vertex, set, face;
    friend auto operator<=>(const Corner&, const Corner&) = default;
  };

  /// `class_of`: the position class of each vertex.
  CoincidentFaces(const SurfaceView& surface, std::span<const Index> class_of);

  /// Two different faces of one set?
  bool coincide(Index f, Index g) const { return f != g && set_of_[f] >= 0 && set_of_[f] == set_of_[g]; }
  std::span<const Corner> corners_at(Index vertex) const;

 private:
  std::vector<Index> set_of_;    // by face; -1 where no other face has equal corners
  std::vector<Corner> corners_;  // sorted; nearly always empty
};

}  // namespace unsnarl
