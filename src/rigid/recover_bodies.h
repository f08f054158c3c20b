#pragma once

#include <functional>
#include <limits>

#include "rigid/bodies.h"

namespace unsnarl {

struct RecoverBodiesOptions {
  double min_gap = 0;  ///< wanted distance between a body and what it must not intersect, a length
  /// Largest displacement that a vertex may have, a length.
  double most_motion = std::numeric_limits<double>::infinity();
  bool opens_gaps_at_rest = false;  ///< also where bodies are closer than min_gap at rest
  std::function<bool()> stop = {};
};

/// Moves placed bodies back toward rest, all together, as far as contacts between them and with obstacles allow. Each
/// step minimises the sum of squared displacements of their vertices (a quadratic function of six numbers a body)
/// subject to the linearised distances of what is near, by projected Gauss-Seidel on the contact forces. A step that
/// ends with an intersection, below min_gap or farther from rest is shortened. Where the gap is less than wanted, steps
/// open it first; bodies that are closer than that to each other or to obstacles at rest stay so, unless
/// opens_gaps_at_rest. \pre bodies with is_placed intersect nothing that they must not.
void recover_bodies(Bodies& bodies, const RecoverBodiesOptions& options);

}  // namespace unsnarl
