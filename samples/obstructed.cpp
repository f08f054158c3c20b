#include <algorithm>

#include "samples/klein_maps.h"
#include "samples/projective_maps.h"
#include "samples/sample_maker.h"

namespace unsnarl {

std::vector<SampleMaker> obstructed_samples() {
  constexpr bool embeddable = false;
  return {
      {{"klein_bottle",
        "closed Klein bottle: no motion of its vertices can embed it, repair has to refuse",
        {},
        embeddable},
       72,
       [](int resolution, const SampleValues&) {
         return sample_grid(klein_bottle_grid(resolution, FaceKind::quads), klein_bottle_map);
       }},
      {{"boy_surface",
        "closed projective plane with one triple point: no motion of its vertices can embed it, repair has to refuse",
        {},
        embeddable},
       100,
       [](int resolution, const SampleValues&) {
         return sample_projective_plane(std::max(2, resolution / 4), FaceKind::triangles, boy_map);
       }},
  };
}

}  // namespace unsnarl
