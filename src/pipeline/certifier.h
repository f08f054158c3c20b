#pragma once

#include <span>

#include "scene/face_pairs.h"
#include "scene/prepared_surface.h"
#include "unsnarl/certify.h"

namespace unsnarl {

/// What certify() does, its two searches apart. The surface must outlive it.
class Certifier {
 public:
  explicit Certifier(const SurfaceView& input, const FindOptions& options);

  /// All but the pairs in float32. Throws std::invalid_argument as certify() does.
  Certificate certify(std::span<const double> positions);
  PairCounts pairs_in_float32(std::span<const double> positions);

 private:
  SurfaceView input_;
  FindOptions options_;
  PreparedSurface prepared_;
  FacePairFinder finder_;
};

}  // namespace unsnarl
