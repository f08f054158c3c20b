#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// A projected vertex: pixels and one over the depth. inverse_depth <= 0: behind the eye, not drawn.
struct ScreenPoint {
  float x = 0, y = 0, inverse_depth = 0;
};

/// For each sample of an image, the nearest triangle.
struct VisibilityBuffer {
  int width = 0, height = 0;
  std::vector<float> inverse_depth;  ///< 0: nothing
  std::vector<Index> triangle;       ///< -1: nothing

  VisibilityBuffer(int w, int h)
      : width(w), height(h), inverse_depth(std::size_t(w) * h, 0.0F), triangle(std::size_t(w) * h, -1) {}
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// Weights of the corners of a screen triangle at a point: affine, sum 1. All 0 for a triangle without area.
std::array<float, 3> screen_weights(const std::array<ScreenPoint, 3>& corners, float x, float y);

/// Draws the triangles `ids` (of `triangles`, corners index `points`); of equally near ones the first drawn stays.
/// Samples are at pixel centres; triangles with a corner behind the eye are left out.
void rasterise(std::span<const ScreenPoint> points, std::span<const Triangle> triangles, std::span<const Index> ids,
               VisibilityBuffer& buffer);

}  // namespace unsnarl
