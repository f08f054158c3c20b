#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

struct AmbientOcclusionOptions {
  double radius_pixels = 40;  ///< Occluders are looked for up to this far away (unit: pixels)
  double strength = 1.1;      ///< Factor of the occlusion; 0: none (no unit)
  int samples = 14;           ///< Samples that are taken for a pixel (unit: samples)
};

/// How much of the sky each pixel sees, in [0, 1], from what is in front of it on the screen: the estimator of
/// M. McGuire, B. Osman, M. Bukowski, P. Hennessy: "The Alchemy Screen-Space Ambient Obscurance Algorithm" (2011), with
/// a blur that keeps to the surface.
///
/// points: the surface point of each pixel in the camera's frame (x right, y up, z toward the eye, eye at 0), (0, 0, 0)
/// where there is none; normals: unit, turned to the eye. pixel_tangent: size of a pixel at depth 1.
std::vector<float> ambient_occlusion(std::span<const Eigen::Vector3f> points, std::span<const Eigen::Vector3f> normals,
                                     int width, int height, double pixel_tangent,
                                     const AmbientOcclusionOptions& options);

}  // namespace unsnarl
