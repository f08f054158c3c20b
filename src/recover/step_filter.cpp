#include "recover/step_filter.h"

namespace unsnarl {

void filter_step(std::span<const SeparatedStencil> stencils, const OrientedFaces& oriented, const Positions& x,
                 Positions& p, OnCollision on_collision, const CcdOptions& options) {
  // Corners of faces that would still flip do not move at all, so that the loop ends.
  const double factor = on_collision == OnCollision::stay ? 0 : 0.5;
  oriented.orientation.filter(x, oriented.faces, oriented.share, factor, p);
  do {
    filter_displacements(stencils, x, p, on_collision, options);
  } while (oriented.orientation.filter(x, oriented.faces, oriented.share, 0, p));
}

}  // namespace unsnarl
