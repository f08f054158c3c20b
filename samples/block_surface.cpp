#include "samples/block_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace unsnarl {
namespace {

/// Averaging moves a vertex to the mean of its neighbours along cell edges; the radius reached grows with the square
/// root of the number of rounds.
void round_off(Surface& surface, const std::set<std::array<Index, 2>>& edges, int rounds) {
  const std::size_t n = surface.positions.size() / 3;
  std::vector<double> sum(3 * n);
  std::vector<int> degree(n);
  for (const auto& e : edges)
    for (Index v : e) ++degree[v];
  for (int round = 0; round < rounds; ++round) {
    std::fill(sum.begin(), sum.end(), 0.0);
    for (const auto& [a, b] : edges)
      for (std::size_t k = 0; k < 3; ++k) {
        sum[3 * a + k] += surface.positions[3 * b + k];
        sum[3 * b + k] += surface.positions[3 * a + k];
      }
    for (std::size_t v = 0; v < n; ++v)
      for (std::size_t k = 0; k < 3; ++k)
        surface.positions[3 * v + k] = 0.5 * (surface.positions[3 * v + k] + sum[3 * v + k] / degree[v]);
  }
}

}  // namespace

Surface sample_blocks(const std::vector<Block>& blocks, int divisions, FaceKind faces, double roundness,
                      const std::function<bool(const Vec3& middle)>& keep) {
  const std::set<Block> filled(blocks.begin(), blocks.end());
  MeshBuilder builder;
  std::map<std::array<int, 3>, Index> known;
  std::set<std::array<Index, 2>> edges;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [entry, is_new] = known.try_emplace(p, 0);
    if (is_new) entry->second = builder.add_vertex(Vec3(p[0], p[1], p[2]) / divisions);
    return entry->second;
  };
  for (const Block& block : filled)
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side <= 1; ++side) {
        Block beyond = block;
        beyond[axis] += 2 * side - 1;
        if (filled.contains(beyond)) continue;
        Vec3 middle(block[0] + 0.5, block[1] + 0.5, block[2] + 0.5);
        middle[axis] = block[axis] + side;
        if (keep && !keep(middle)) continue;
        for (int i = 0; i < divisions; ++i)
          for (int j = 0; j < divisions; ++j) {
            const auto corner = [&](int a, int b) {
              std::array<int, 3> p{};
              p[axis] = (block[axis] + side) * divisions;
              p[(axis + 1) % 3] = block[(axis + 1) % 3] * divisions + a;
              p[(axis + 2) % 3] = block[(axis + 2) % 3] * divisions + b;
              return vertex(p);
            };
            std::array<Index, 4> c = {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
            if (side == 0) std::swap(c[1], c[3]);
            for (std::size_t k = 0; k < 4; ++k) {
              const auto [low, high] = std::minmax(c[k], c[(k + 1) % 4]);
              edges.insert({low, high});
            }
            builder.add_cell(c[0], c[1], c[2], c[3], faces, (i + j) % 2 != 0);
          }
      }
  Surface surface = builder.take();
  const double rounds = 2 * roundness * roundness * divisions * divisions;
  round_off(surface, edges, std::max(1, static_cast<int>(std::lround(rounds))));
  return surface;
}

}  // namespace unsnarl
