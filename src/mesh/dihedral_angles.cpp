#include "mesh/dihedral_angles.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/portable_math.h"
#include "mesh/adjacency.h"

namespace unsnarl {
namespace {

Index third_corner(const Triangle& t, const Edge& edge) {
  for (const Index v : t)
    if (v != edge[0] && v != edge[1]) return v;
  return -1;
}

using Exact = boost::multiprecision::cpp_rational;
using ExactVector = std::array<Exact, 3>;

ExactVector difference(const Positions& x, Index to, Index from) {
  ExactVector result;
  for (int k = 0; k < 3; ++k) result[k] = Exact(x(k, to)) - Exact(x(k, from));
  return result;
}
ExactVector cross(const ExactVector& u, const ExactVector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
Exact dot(const ExactVector& u, const ExactVector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

}  // namespace

std::vector<Hinge> hinges_of(std::span<const Triangle> triangles) {
  const EdgeTable table = build_edges(triangles);
  std::vector<Hinge> hinges;
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const std::span<const Index> around = table.triangles_of_edge[static_cast<Index>(e)];
    for (std::size_t i = 0; i < around.size(); ++i)
      for (std::size_t j = i + 1; j < around.size(); ++j) {
        const Edge& edge = table.edges[e];
        const Hinge hinge = {
            edge[0],   edge[1],  third_corner(triangles[around[i]], edge), third_corner(triangles[around[j]], edge),
            around[i], around[j]};
        if (hinge.c >= 0 && hinge.d >= 0 && hinge.c != hinge.d) hinges.push_back(hinge);
      }
  }
  return hinges;
}

HingeAngle hinge_angle(const Positions& x, const Hinge& hinge) {
  // Across the edge, turned by a right angle: the angle between the normals of the half-planes is that between them.
  const Vec3 edge = x.col(hinge.b) - x.col(hinge.a);
  const Vec3 first = x.col(hinge.c) - x.col(hinge.a), second = x.col(hinge.d) - x.col(hinge.a);
  const Vec3 u = edge.cross(first), w = edge.cross(second);
  const double length_u = u.norm(), length_w = w.norm();
  constexpr double infinite = std::numeric_limits<double>::infinity(), unit = std::numeric_limits<double>::epsilon();
  if (!(length_u > 0) || !(length_w > 0)) return {0, infinite};
  // A difference has an error of half a unit a coordinate, a product of two and their difference of some units of
  // |edge| |first|; the direction of u turns by that / |u|. Sixteen units hold with room to spare, also for what
  // follows.
  const double error = 16 * unit * (1 + edge.norm() * (first.norm() / length_u + second.norm() / length_w));
  return {portable::atan2(u.cross(w).norm() / (length_u * length_w), u.dot(w) / (length_u * length_w)), error};
}

std::optional<double> exact_hinge_angle(const Positions& x, const Hinge& hinge) {
  const ExactVector edge = difference(x, hinge.b, hinge.a);
  const ExactVector u = cross(edge, difference(x, hinge.c, hinge.a)), w = cross(edge, difference(x, hinge.d, hinge.a));
  if (dot(u, u) == 0 || dot(w, w) == 0) return {};
  const Exact cosine = dot(u, w);  // times both lengths, as is the sine
  if (cosine == 0) return std::numbers::pi / 2;
  const ExactVector sine = cross(u, w);
  const Exact squared_tangent = dot(sine, sine) / (cosine * cosine);
  const double angle = portable::atan(std::sqrt(squared_tangent.convert_to<double>()));
  return cosine > 0 ? angle : std::numbers::pi - angle;
}

SmallestAngle smallest_angle(const Positions& x, std::span<const Hinge> hinges) {
  // Only what may be the smallest is looked at exactly.
  double bound = std::numeric_limits<double>::infinity();
  std::vector<HingeAngle> angles;
  angles.reserve(hinges.size());
  for (const Hinge& hinge : hinges) {
    angles.push_back(hinge_angle(x, hinge));
    bound = std::min(bound, angles.back().radians + angles.back().error);
  }
  SmallestAngle smallest;
  for (std::size_t i = 0; i < hinges.size(); ++i) {
    if (std::isfinite(angles[i].error) && angles[i].radians - angles[i].error > bound) continue;
    const std::optional<double> exact = exact_hinge_angle(x, hinges[i]);
    if (exact && (smallest.hinge < 0 || *exact < smallest.radians)) smallest = {*exact, static_cast<std::ptrdiff_t>(i)};
  }
  return smallest;
}

}  // namespace unsnarl
