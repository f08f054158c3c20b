#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace unsnarl {

/// A polygon mesh that somebody else owns, as flat arrays.
///
/// - `positions`: 3 n doubles, x y z of vertex 0, then of vertex 1, ...
/// - `corners`:   the 0-based vertex ids of all faces, face after face.
/// - `offsets`:   m + 1 entries; face f has corners [offsets[f], offsets[f + 1]). Empty: every face is a triangle.
///
/// Example, one quad: positions of 4 vertices, corners {0, 1, 2, 3}, offsets {0, 4}.
struct SurfaceView {
  std::span<const double> positions;
  std::span<const std::int32_t> corners;
  std::span<const std::int32_t> offsets = {};

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t face_count() const { return offsets.empty() ? corners.size() / 3 : offsets.size() - 1; }
  std::span<const std::int32_t> face(std::size_t f) const {
    return offsets.empty() ? corners.subspan(3 * f, 3) : corners.subspan(offsets[f], offsets[f + 1] - offsets[f]);
  }
};

/// A polygon mesh that owns its arrays; same layout as SurfaceView.
struct Surface {
  std::vector<double> positions;
  std::vector<std::int32_t> corners;
  std::vector<std::int32_t> offsets;

  operator SurfaceView() const { return {positions, corners, offsets}; }
  SurfaceView view() const { return *this; }
};

}  // namespace unsnarl
