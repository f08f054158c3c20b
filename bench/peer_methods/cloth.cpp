#include "cloth.h"

namespace unsnarl::peers {
namespace {

constexpr double stretch_stiffness = 0.5;  // share of the difference, a sweep
constexpr double bend_stiffness = 0.1;

Index corner_opposite(const Triangle& t, const Edge& edge) {
  for (Index v : t)
    if (v != edge[0] && v != edge[1]) return v;
  return t[0];
}

}  // namespace

Cloth::Cloth(const Positions& rest, std::span<const Triangle> triangles, const EdgeTable& edges) {
  const auto add = [&](Index i, Index j, double stiffness) {
    if (i != j) springs_.push_back({i, j, (rest.col(i) - rest.col(j)).norm(), stiffness});
  };
  for (std::size_t e = 0; e < edges.edges.size(); ++e) {
    const Edge& edge = edges.edges[e];
    add(edge[0], edge[1], stretch_stiffness);
    const auto around = edges.triangles_of_edge[static_cast<Index>(e)];
    if (around.size() == 2)
      add(corner_opposite(triangles[around[0]], edge), corner_opposite(triangles[around[1]], edge), bend_stiffness);
  }
}

void Cloth::relax(Positions& x, int sweeps) const {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (const Spring& spring : springs_) {
      const Vec3 between = x.col(spring.j) - x.col(spring.i);
      const double length = between.norm();
      if (!(length > 0)) continue;
      const Vec3 correction = 0.5 * spring.stiffness * (length - spring.length) / length * between;
      x.col(spring.i) += correction;
      x.col(spring.j) -= correction;
    }
  }
}

}  // namespace unsnarl::peers
