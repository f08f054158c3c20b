#include "geometry/parallel.h"
#include "scene/face_pairs.h"
#include "scene/prepared_surface.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

std::vector<IntersectingPair> find_intersections(const SurfaceView& surface, const FindOptions& options) {
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(surface, options);
  return FacePairFinder(prepared).find(prepared.rest);
}

}  // namespace unsnarl
