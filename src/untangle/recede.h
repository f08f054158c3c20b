#pragma once

#include <array>
#include <functional>
#include <span>

#include "scene/patch.h"
#include "unsnarl/intersections.h"
#include "untangle/shared_constants.h"

namespace unsnarl {

/// Constants of recede(). h is the patch's edge length.
struct RecedeOptions {
  /// Shares of the way to the spine that a receding boundary is tried at: from the first on, so much apart. First clean
  /// for a punctured Boy's surface 0.3, Klein bottle 0.5, Roman surface 0.5, cross-cap 0.7, a patch of Henneberg's
  /// surface 0.8.
  double first_share = 0.3;
  double share_step = 0.1;
  int iterations = 120;  ///< of the contour method; the last ones to succeed needed 111
  struct Stride {
    double step_rel, locality_rel;
  };
  /// Step and locality of that method, of the diagonal, at least 0.3 h and 4 h: fine meshes must go as far as coarse
  /// ones. All shares are tried with the first before the second.
  std::array<Stride, 2> strides = {{{0.009, 0.12}, {0.02, 0.28}}};
  double jitter = symmetry_jitter;
  double floor = 0.02;                ///< of its area at rest: with thinner faces than this, further shares are tried
  double last_floor = squeezed_area;  ///< the same where none is left
};

struct RecedeResult {
  bool clean = false;  ///< no active triangle intersects another (but for the tolerated pairs), none is squeezed
  int iterations = 0;
};

/// Lets the boundary of the patch's surface recede along the surface from patch.rest (Recession), then parts what is
/// left by the contour method: for surfaces that nothing short of moving the boundary through them can part, such as
/// punctured projective planes and Klein bottles. Pairs of faces on the same three vertices and `tolerated` pairs
/// (sorted, of patch triangles) are let be. Where it fails, patch.x is patch.rest.
RecedeResult recede(Patch& patch, const std::function<bool()>& stop = {},
                    std::span<const IntersectingPair> tolerated = {}, const RecedeOptions& options = {});

}  // namespace unsnarl
