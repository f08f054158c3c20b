#include "render/camera.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "geometry/box.h"
#include "geometry/portable_math.h"
#include "geometry/rotation.h"

namespace unsnarl {

std::optional<Vec3> up_of(std::span<const SceneFile> files) {
  for (const SceneFile& file : files)
    if (file.up) return Vec3(file.up->data());
  return {};
}

Camera three_quarter_view(std::span<const double> positions, double aspect, double margin,
                          const std::optional<Vec3>& up) {
  Box box;
  for (std::size_t k = 0; k + 2 < positions.size(); k += 3) {
    const Vec3 p(positions[k], positions[k + 1], positions[k + 2]);
    if (p.allFinite()) box.extend(p);
  }
  Camera camera;
  if (!(box.lo[0] <= box.hi[0])) box = {Vec3::Zero(), Vec3::Ones()};
  const Vec3 extent = box.hi - box.lo;

  // A quarter more than both others is a standing figure in a z-up file; less could be a body of y up seen from its
  // side.
  const bool z_up = extent[2] > 1.25 * std::max(extent[0], extent[1]);
  const Vec3 vertical = up ? *up : z_up ? Vec3::UnitZ() : Vec3::UnitY();
  Eigen::Index axis = 0;
  vertical.cwiseAbs().maxCoeff(&axis);
  Vec3 across = axis == 0 ? Vec3::UnitY() : Vec3::UnitX(), beside = axis == 2 ? Vec3::UnitY() : Vec3::UnitZ();
  if (beside.dot(extent) > 1.02 * across.dot(extent)) std::swap(across, beside);
  const Vec3 viewer = across.cross(vertical);  // as z = x cross y

  // Flat things are looked at from further above.
  const double flatness = extent[axis] / std::max({extent[0], extent[1], extent[2], 1e-300});
  const double elevation = (flatness < 0.35 ? 38 : 22) * std::numbers::pi / 180;
  const double azimuth = -30 * std::numbers::pi / 180;
  const Eigen::Matrix3d turn = rotation_about(vertical, azimuth);
  camera.right = turn * across;
  const Vec3 level = turn * viewer;
  camera.toward = portable::cos(elevation) * level + portable::sin(elevation) * vertical;
  camera.up = camera.toward.cross(camera.right);

  // The nearest eye from which every point p lies within the four planes of the view: with t the tangent of half the
  // field of view and z along `toward`, |x - eye_x| <= t (eye_z - z).
  camera.half_height = portable::tan(13 * std::numbers::pi / 180);
  const double ty = camera.half_height * (1 - 2 * margin), tx = camera.half_height * aspect * (1 - 2 * margin);
  double left = -std::numeric_limits<double>::infinity(), right = left, below = left, above = left, nearest = left;
  const Vec3 middle = box.center();
  const auto include = [&](const Vec3& p) {
    const Vec3 d = p - middle;
    const double x = camera.right.dot(d), y = camera.up.dot(d), z = camera.toward.dot(d);
    right = std::max(right, x + tx * z);
    left = std::max(left, -x + tx * z);
    above = std::max(above, y + ty * z);
    below = std::max(below, -y + ty * z);
    nearest = std::max(nearest, z);
  };
  bool any = false;
  for (std::size_t k = 0; k + 2 < positions.size(); k += 3) {
    const Vec3 p(positions[k], positions[k + 1], positions[k + 2]);
    if (!p.allFinite()) continue;
    include(p);
    any = true;
  }
  if (!any) {
    include(box.lo);
    include(box.hi);
  }
  // A single point, or points on a line of sight, still need some distance.
  const double least = nearest + std::max(0.05 * box.diagonal(), 1e-12 * (1 + middle.cwiseAbs().maxCoeff()));
  const double distance = std::max({(left + right) / (2 * tx), (below + above) / (2 * ty), least});
  camera.eye =
      middle + 0.5 * (right - left) * camera.right + 0.5 * (above - below) * camera.up + distance * camera.toward;
  return camera;
}

}  // namespace unsnarl
