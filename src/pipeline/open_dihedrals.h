#pragma once

#include <functional>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

struct OpenDihedralsOptions {
  double least_radians = 0;  ///< faces at an edge are opened to this angle; the least that any pair of faces may have
  double most_motion = 0;    ///< length: no vertex goes farther from rest; 0: any distance
  double least_gap = 0;      ///< length: faces that share no vertex do not come closer than this
  /// Positions as they will be read back from the file.
  std::function<Positions(const Positions& x)> as_written;
  /// The intersecting pairs at these positions, sorted: those of now, and whatever else a step must not bring.
  std::function<std::vector<IntersectingPair>(const Positions& x)> pairs_at;
  std::function<bool()> stop;
};

/// Opens every two faces at an edge that are folded together closer than the least angle: each hinge is turned by the
/// shortest motion of its four vertices that does so, round after round, and what would bring an intersecting pair
/// (by exact predicates) or a gap below the least is taken back, on the positions as they will be written. Faces whose
/// vertices are all fixed stay. Returns the number of hinges that remain closer.
std::size_t open_dihedrals(Scene& scene, const OpenDihedralsOptions& options);

}  // namespace unsnarl
