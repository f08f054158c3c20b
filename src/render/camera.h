#pragma once

#include <optional>
#include <span>

#include "geometry/types.h"
#include "unsnarl/scene_document.h"

namespace unsnarl {

/// A perspective camera and the part of its image plane that is drawn.
struct Camera {
  Vec3 right, up, toward;  ///< orthonormal; `toward` points from the scene to the eye
  Vec3 eye;
  double half_height = 0.25;          ///< tangent of half the vertical field of view
  double centre_x = 0, centre_y = 0;  ///< middle of the drawn part, in the units of half_height

  /// Pixels (x right, y down) and depth (> 0 in front of the eye) in an image of this size.
  Vec3 project(const Vec3& p, double width, double height) const {
    const Vec3 d = p - eye;
    const double depth = -toward.dot(d), scale = 0.5 * height / half_height;
    return {0.5 * width + scale * (right.dot(d) / depth - centre_x),
            0.5 * height - scale * (up.dot(d) / depth - centre_y), depth};
  }
};

/// The axis that points up by the first of these files that says so.
std::optional<Vec3> up_of(std::span<const SceneFile> files);

/// The view from a three-quarter angle above that shows all of `positions` (3 a point, finite ones count) as large as
/// possible; the longer horizontal axis to the right. up: an axis or its opposite; none: y, or z where the points reach
/// much further along z.
/// aspect: width over height of the image; margin: share of it that stays free on each side.
Camera three_quarter_view(std::span<const double> positions, double aspect, double margin,
                          const std::optional<Vec3>& up = {});

}  // namespace unsnarl
