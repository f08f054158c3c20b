#include "pipeline/certifier.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "mesh/areas.h"
#include "scene/rounding.h"

namespace unsnarl {

Certifier::Certifier(const SurfaceView& input, const FindOptions& options)
    : input_(input), options_(options), prepared_(prepare(input, options)), finder_(prepared_) {}

Certificate Certifier::certify(std::span<const double> positions) {
  if (positions.size() != input_.positions.size())
    throw std::invalid_argument("there are " + std::to_string(positions.size() / 3) + " positions for a surface of " +
                                std::to_string(input_.vertex_count()) + " vertices");
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (!std::isfinite(positions[k]))
      throw std::invalid_argument("vertex " + std::to_string(k / 3) + " has a coordinate that is not finite");
  const Positions x = prepared_.gather(positions);
  Certificate certificate;
  const std::vector<Index>& id = prepared_.weld_map.vertex_of;
  for (std::size_t v = 0; v < id.size() && options_.weld_tolerance == 0; ++v)
    for (int k = 0; k < 3; ++k) certificate.seams_closed &= positions[3 * v + k] == x(k, id[v]);
  certificate.new_zero_area_faces = count_lost_areas(prepared_.rest, x, prepared_.triangles());
  certificate.pairs = count_by_class(finder_.find(x));
  return certificate;
}

PairCounts Certifier::pairs_in_float32(std::span<const double> positions) {
  const Positions x = prepared_.gather(positions);
  PairCounts pairs = count_by_class(finder_.find(rounded_to_float32(x)));
  if (!fits_float32(x)) ++pairs[PairClass::degenerate];
  return pairs;
}

}  // namespace unsnarl
