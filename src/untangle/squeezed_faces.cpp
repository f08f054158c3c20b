#include "untangle/squeezed_faces.h"

#include "mesh/areas.h"

namespace unsnarl {

bool has_squeezed_face(const Patch& patch, const Positions& start, const Positions& x, double floor) {
  for (Index t = 0; t < patch.active_count; ++t)
    if (triangle_area(x, patch.triangles[t]) < floor * triangle_area(start, patch.triangles[t])) return true;
  return false;
}

}  // namespace unsnarl
