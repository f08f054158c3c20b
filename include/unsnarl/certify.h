#pragma once

#include <cstddef>
#include <span>

#include "unsnarl/intersections.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// What an exact check of given positions found. Vertices are welded and polygons cut by the *input*, so vertices
/// that have come to coincide since intersect.
struct Certificate {
  PairCounts pairs;                     ///< intersecting pairs of faces
  PairCounts pairs_float32;             ///< the same after rounding all positions to float32; what is beyond its range
                                        ///< counts as one degenerate pair
  std::size_t new_zero_area_faces = 0;  ///< triangles without area that had some in the input
  bool seams_closed = true;             ///< vertices that count as one are at one position

  /// The promise: no two faces meet anywhere but in the hull of the vertices they share.
  bool embedded() const { return pairs.total() == 0 && new_zero_area_faces == 0 && seams_closed; }
  bool float32_embedded() const { return pairs_float32.total() == 0; }
};

/// Decides exactly whether `positions` (3 n doubles, vertex order of `input`) embed the input's faces.
///
/// Throws std::invalid_argument when the number of positions differs or a coordinate is not finite.
Certificate certify(const SurfaceView& input, std::span<const double> positions, const FindOptions& options = {});

}  // namespace unsnarl
