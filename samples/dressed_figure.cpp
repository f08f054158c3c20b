#include "samples/dressed_figure.h"

#include <algorithm>
#include <cmath>

#include "geometry/portable_math.h"
#include "samples/block_surface.h"

namespace unsnarl {
namespace {

/// Unit normals of the vertices, of the areas around them.
std::vector<Vec3> vertex_normals(const SurfaceView& surface) {
  std::vector<Vec3> normals(surface.vertex_count(), Vec3::Zero());
  const auto at = [&](Index v) { return Eigen::Map<const Vec3>(&surface.positions[3 * static_cast<std::size_t>(v)]); };
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto face = surface.face(f);
    const Vec3 normal = (at(face[1]) - at(face[0])).cross(at(face[2]) - at(face[0]));
    for (const Index v : face) normals[static_cast<std::size_t>(v)] += normal;
  }
  for (Vec3& normal : normals) normal.normalize();
  return normals;
}

}  // namespace

Surface dressed_figure(int resolution, const SampleValues& values) {
  std::vector<Block> figure, tunic;
  const auto add = [](std::vector<Block>& blocks, int x0, int x1, int y0, int y1) {
    for (int x = x0; x < x1; ++x)
      for (int y = y0; y < y1; ++y)
        for (int z = -1; z < 1; ++z) blocks.push_back({x, y, z});
  };
  add(figure, 0, 5, 0, 6);                             // torso
  add(figure, 0, 2, -5, 0), add(figure, 3, 5, -5, 0);  // legs
  add(figure, -4, 0, 4, 6), add(figure, 5, 9, 4, 6);   // arms
  add(figure, 2, 3, 6, 7), add(figure, 1, 4, 7, 10);   // neck, head
  constexpr int hem = -2, left_cuff = -2, right_cuff = 7, shoulder = 6;
  add(tunic, 0, 5, hem, shoulder);
  add(tunic, left_cuff, 0, 4, 6), add(tunic, 5, right_cuff, 4, 6);
  const auto is_cloth = [](const Vec3& p) {
    const bool is_neck = p[1] == shoulder && std::abs(p[0] - 2.5) < 1.4;
    return p[1] != hem && p[0] != left_cuff && p[0] != right_cuff && !is_neck;
  };
  const int divisions = std::max(1, resolution / 17);
  MeshBuilder builder;
  builder.append(sample_blocks(figure, divisions, FaceKind::triangles, 0.8));
  Surface cloth = sample_blocks(tunic, divisions, FaceKind::triangles, 0.7, is_cloth);
  const std::vector<Vec3> normals = vertex_normals(cloth);
  const double ease = values["ease"], folds = values["folds"];
  for (std::size_t v = 0; v < normals.size(); ++v) {
    Eigen::Map<Vec3> p(&cloth.positions[3 * v]);
    // Folds run down the body and around the sleeves, deeper toward the hem.
    const double down = std::clamp((shoulder - p[1]) / (shoulder - hem), 0.0, 1.0);
    const double wave = portable::sin(4.1 * p[0] + 0.8 * p[1]) * portable::cos(1.3 * p[2] + 0.4);
    p += (ease + 0.3 * down * down * down + folds * (0.5 + down) * wave) * normals[v];
  }
  builder.append(cloth);
  Surface surface = builder.take();
  for (double& coordinate : surface.positions) coordinate *= 0.1;
  return surface;
}

}  // namespace unsnarl
