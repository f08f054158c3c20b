#include "unsnarl/certify.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "repair/face_pairs.h"
#include "repair/prepared_surface.h"
#include "repair/rounding.h"
#include "repair/threads.h"

namespace unsnarl {
Certificate certify(const SurfaceView& input, std::span<const double> positions, const FindOptions& options) {
  if (positions.size() != input.positions.size())
    throw std::invalid_argument("there are " + std::to_string(positions.size() / 3) + " positions for a surface of " +
                                std::to_string(input.vertex_count()) + " vertices");
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (!std::isfinite(positions[k]))
      throw std::invalid_argument("vertex " + std::to_string(k / 3) + " has a coordinate that is not finite");
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(input, options);
  const Positions x = prepared.gather(positions);
  Certificate certificate;
  const std::vector<Index>& id = prepared.identification.vertex_of;
  for (std::size_t v = 0; v < id.size() && options.weld_tolerance == 0; ++v)
    for (int k = 0; k < 3; ++k) certificate.seams_closed &= positions[3 * v + k] == x(k, id[v]);
  certificate.new_zero_area_faces = count_lost_areas(prepared.rest, x, prepared.triangles());
  certificate.triangle_pairs = IntersectionFinder(prepared.triangles()).find(x).size();
  FacePairFinder finder(prepared);
  certificate.pairs = count_by_class(finder.find(x));
  certificate.pairs_float32 = count_by_class(finder.find(rounded_to_float32(x)));
  if (!fits_float32(x)) ++certificate.pairs_float32[PairClass::degenerate];
  return certificate;
}

std::vector<IntersectingPair> find_intersections(const SurfaceView& surface, const FindOptions& options) {
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(surface, options);
  return FacePairFinder(prepared).find(prepared.rest);
}

}  // namespace unsnarl
