#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "applications/seifert/closed_tube.h"
#include "geometry/box.h"
#include "mesh/union_find.h"
#include "unsnarl/intersections.h"
#include "unsnarl/seifert.h"

namespace unsnarl {
namespace {

constexpr int sides_of_tube = 12;  ///< Corners of a ring (unit: corners)
/// The first radius that is tried, thick enough to see (unit: diagonal of the link's bounding box)
constexpr double thickest_tube_rel = 0.02;
constexpr double thinner = 0.7;      ///< Each next radius that is tried (unit: the one before)
constexpr int most_tube_tries = 24;  ///< Radii that are tried: the last is 3e-4 of the first (unit: tries)

bool have_common_corner(const SurfaceView& s, Index f, Index g) {
  const auto a = s.face(static_cast<std::size_t>(f)), b = s.face(static_cast<std::size_t>(g));
  return std::any_of(a.begin(), a.end(), [&](auto v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

}  // namespace

bool is_clear_tube(const SurfaceView& tube, const SurfaceView& spanning) {
  Surface both{{tube.positions.begin(), tube.positions.end()}, {tube.corners.begin(), tube.corners.end()}, {}};
  both.positions.insert(both.positions.end(), spanning.positions.begin(), spanning.positions.end());
  const auto vertices = static_cast<Index>(tube.vertex_count()), faces = static_cast<Index>(tube.face_count());
  for (const Index v : spanning.corners) both.corners.push_back(vertices + v);
  FindOptions find;
  find.weld = Weld::none;
  const std::vector<IntersectingPair> pairs = find_intersections(both, find);
  std::map<std::array<Index, 2>, int> uses;
  UnionFind tori(static_cast<std::size_t>(vertices));
  for (Index f = 0; f < faces; ++f) {
    const auto t = tube.face(static_cast<std::size_t>(f));
    if (t.size() != 3) return false;
    for (int k = 0; k < 3; ++k) {
      tori.unite(t[k], t[(k + 1) % 3]);
      ++uses[{t[k], t[(k + 1) % 3]}];
    }
  }
  for (const auto& [edge, count] : uses)
    if (const auto other = uses.find({edge[1], edge[0]}); count != 1 || other == uses.end() || other->second != 1)
      return false;
  // Pairs of a face of the tube and one of the surface, linked where a curve in both may run on.
  std::vector<std::array<Index, 2>> met;
  for (const IntersectingPair& p : pairs) {
    if (p.b < faces) return false;  // a < b: the tube runs through itself
    if (p.a < faces) met.push_back({p.a, p.b});
  }
  const SurfaceView view = both.view();
  std::map<Index, std::vector<Index>> of_face;  // of either, the pairs
  for (std::size_t k = 0; k < met.size(); ++k)
    for (const Index f : met[k]) of_face[f].push_back(static_cast<Index>(k));
  UnionFind curves(met.size());
  for (const auto& [face, its] : of_face)
    for (std::size_t i = 0; i < its.size(); ++i)
      for (std::size_t j = i + 1; j < its.size(); ++j) {
        const int other = face < faces ? 1 : 0;
        if (have_common_corner(view, met[its[i]][other], met[its[j]][other])) curves.unite(its[i], its[j]);
      }
  std::map<Index, int> curves_of_torus;
  for (Index v = 0; v < vertices; ++v) curves_of_torus[tori.find(v)];
  for (std::size_t k = 0; k < met.size(); ++k)
    if (curves.find(static_cast<Index>(k)) == static_cast<Index>(k))
      ++curves_of_torus[tori.find(tube.face(static_cast<std::size_t>(met[k][0]))[0])];
  return std::all_of(curves_of_torus.begin(), curves_of_torus.end(), [](const auto& c) { return c.second == 1; });
}

KnotTube knot_tube(const Link& link, const SurfaceView& spanning) {
  check_link(link);
  spanning_boundary(spanning);
  Box box;
  for (const std::vector<double>& p : link.components)
    for (std::size_t k = 0; k < p.size(); k += 3) box.extend(Vec3(p[k], p[k + 1], p[k + 2]));
  KnotTube made;
  made.radius = thickest_tube_rel * box.diagonal();
  for (int k = 0; k < most_tube_tries; ++k, made.radius *= thinner) {
    made.surface = {};
    for (const std::vector<double>& p : link.components)
      add_closed_tube(Eigen::Map<const Positions>(p.data(), 3, static_cast<Index>(p.size() / 3)), made.radius,
                      sides_of_tube, made.surface);
    // Where the link turns right back, rounding may leave nothing to divide by.
    const std::vector<double>& positions = made.surface.positions;
    if (!std::all_of(positions.begin(), positions.end(), [](double p) { return std::isfinite(p); })) return {};
    if (is_clear_tube(made.surface, spanning)) return made;
  }
  return {};
}

}  // namespace unsnarl
