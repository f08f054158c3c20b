#include "unsnarl/certify.h"

#include "pipeline/certifier.h"
#include "pipeline/threads.h"

namespace unsnarl {

Certificate certify(const SurfaceView& input, std::span<const double> positions, const FindOptions& options) {
  const ThreadLimit threads(options.threads);
  Certifier certifier(input, options);
  Certificate certificate = certifier.certify(positions);
  certificate.pairs_float32 = certifier.pairs_in_float32(positions);
  return certificate;
}

std::vector<IntersectingPair> find_intersections(const SurfaceView& surface, const FindOptions& options) {
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(surface, options);
  return FacePairFinder(prepared).find(prepared.rest);
}

}  // namespace unsnarl
