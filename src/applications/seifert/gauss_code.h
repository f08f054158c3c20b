#pragma once

#include <vector>

#include "applications/seifert/planar_layout.h"

namespace unsnarl {

/// A diagram by what is met along its components.
struct GaussCode {
  struct Visit {
    int crossing = 0;  ///< from 0
    bool over = false;
  };
  std::vector<std::vector<Visit>> components;
  /// One a crossing: 1: right-handed, -1: left-handed. Empty: not known. The code then is of a diagram and of its
  /// mirror image, and of a connected sum with some of its summands mirrored.
  std::vector<int> signs;
};

/// Signs that are not known are found by drawing the diagram, so that the first crossing that is met is right-handed.
/// Throws FileError for a code in which a crossing is not met once above and once below, and for one that no diagram in
/// the plane has.
PlanarCode planar_code(GaussCode code);

/// A Dowker-Thistlethwaite code: the even number of the crossings whose odd numbers are 1, 3, 5, ..., one list a
/// component; below 0 where the strands lie the other way than in an alternating diagram. Throws FileError for what is
/// none.
GaussCode gauss_code(const std::vector<std::vector<int>>& dowker_thistlethwaite);

}  // namespace unsnarl
