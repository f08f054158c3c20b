#include "contact/near_along_surface.h"

#include <algorithm>
#include <limits>

#include "contact/distances.h"

namespace unsnarl {
namespace {

/// The radius where no ball joins two places (unit: length)
constexpr double no_ball = std::numeric_limits<double>::infinity();

}  // namespace

NearAlongSurface::NearAlongSurface(std::span<const Triangle> triangles, const Positions& x, const EdgeTable& edges)
    : triangles_(triangles), x_(x), edges_(edges), radius_(triangles.size(), no_ball), is_seen_(triangles.size(), 0) {}

void NearAlongSurface::start(Index from) {
  for (const Index t : met_) radius_[t] = no_ball;
  met_ = {from};
  front_ = {};
  front_.emplace(0.0, from);
  radius_[from] = 0;
  from_ = from;
  const Triangle& f = triangles_[from];
  middle_ = (x_.col(f[0]) + x_.col(f[1]) + x_.col(f[2])) / 3;
}

double NearAlongSurface::distance_to(Index edge, const Vec3& point) const {
  const Edge& e = edges_.edges[edge];
  return closest_vertex_edge(point, x_.col(e[0]), x_.col(e[1])).distance;
}

bool NearAlongSurface::reaches(Index to, double radius) {
  while (!front_.empty() && front_.top().first < radius_[to] && front_.top().first <= radius) {
    const auto [ball, t] = front_.top();
    front_.pop();
    if (ball > radius_[t]) continue;
    for (const Index edge : edges_.edges_of_triangle[t]) {
      if (edge < 0) continue;
      const double through = std::max(ball, distance_to(edge, middle_));
      for (const Index u : edges_.triangles_of_edge[edge]) {
        if (!(through < radius_[u])) continue;
        if (radius_[u] == no_ball) met_.push_back(u);
        radius_[u] = through;
        front_.emplace(through, u);
      }
    }
  }
  return radius_[to] <= radius;
}

bool NearAlongSurface::joins(Index to, const Vec3& centre, double radius) {
  // Balls inside and around the one in question, which all triangles share, decide nearly always.
  const double off = (middle_ - centre).norm();
  if (radius > off && reaches(to, radius - off)) return true;
  return reaches(to, radius + off) && joins_exactly(to, centre, radius);
}

bool NearAlongSurface::joins_exactly(Index to, const Vec3& centre, double radius) {
  seen_ = {from_};
  is_seen_[from_] = 1;
  for (std::size_t k = 0; k < seen_.size() && !is_seen_[to]; ++k)
    for (const Index edge : edges_.edges_of_triangle[seen_[k]]) {
      if (edge < 0 || distance_to(edge, centre) > radius) continue;
      for (const Index u : edges_.triangles_of_edge[edge]) {
        if (is_seen_[u]) continue;
        is_seen_[u] = 1;
        seen_.push_back(u);
      }
    }
  const bool found = is_seen_[to] != 0;
  for (const Index t : seen_) is_seen_[t] = 0;
  return found;
}

}  // namespace unsnarl
