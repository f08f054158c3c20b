#include "applications/seifert/handles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

/// Places in a disc that are looked at, along either axis (unit: places)
constexpr int places_along = 64;
/// Radius of a hexagon, so that neighbours stay apart (unit: radius of the largest circle that fits there)
constexpr double radius_of_room = 0.6;
/// Size of the end of a handle (unit: size of the half of the hexagon that it stands in)
constexpr double end_of_half = 0.5;
/// Segments along a handle: it is as coarse as its hexagon, since fairing draws it anew (unit: segments)
constexpr int segments_of_handle = 6;

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double t = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + t * d - p).norm();
}

/// How large a circle around p may be; below 0: p is outside.
double room_in(const FlatDisc& disc, const Vec2& p) {
  double least = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (std::size_t k = 0; k < disc.outline.size(); ++k) {
    const Vec2 &a = disc.outline[k], &b = disc.outline[(k + 1) % disc.outline.size()];
    least = std::min(least, distance(p, a, b));
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside ? least : -least;
}

double side(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

/// Whether the segments cross within both, or either runs through an end of the other.
bool bars(const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
  if (a == p || a == q || b == p || b == q) return false;
  return side(a, b, p) * side(a, b, q) <= 0 && side(p, q, a) * side(p, q, b) <= 0;
}

bool bars(const FlatDisc& polygon, const Vec2& p, const Vec2& q) {
  for (std::size_t k = 0; k < polygon.outline.size(); ++k)
    if (bars(polygon.outline[k], polygon.outline[(k + 1) % polygon.outline.size()], p, q)) return true;
  return false;
}

/// Whether the way from corner k to q begins inside the polygon, which runs counter-clockwise if `left`: a corner to
/// which bridges lead is there several times.
bool begins_inside(const FlatDisc& polygon, std::size_t k, const Vec2& q, bool left) {
  const std::size_t n = polygon.outline.size();
  const Vec2 &p = polygon.outline[k], &before = polygon.outline[(k + n - 1) % n], &after = polygon.outline[(k + 1) % n];
  const double sign = left ? 1 : -1;
  const bool of_first = sign * side(before, p, q) > 0, of_second = sign * side(p, after, q) > 0;
  return sign * side(before, p, after) > 0 ? of_first && of_second : of_first || of_second;
}

/// Between (a, b) and (c, d).
void add_strip(SpanningMesh& mesh, Index a, Index b, Index c, Index d) {
  mesh.faces.push_back({a, b, d});
  mesh.faces.push_back({a, d, c});
}

}  // namespace

std::vector<HandlePlace> handle_places(std::span<const FlatDisc> discs, int count) {
  std::vector<HandlePlace> candidates;  // as large as the room there
  if (count > 0)
    for (std::size_t d = 0; d < discs.size(); ++d) {
      Vec2 lo = discs[d].outline[0], hi = lo;
      for (const Vec2& p : discs[d].outline) {
        lo = lo.cwiseMin(p);
        hi = hi.cwiseMax(p);
      }
      for (int i = 0; i < places_along; ++i)
        for (int j = 0; j < places_along; ++j) {
          const Vec2 p = lo + (hi - lo).cwiseProduct(Vec2(i + 0.5, j + 0.5) / places_along);
          if (const double room = room_in(discs[d], p); room > 0)
            candidates.push_back({static_cast<Index>(d), p, room});
        }
    }
  std::vector<HandlePlace> places;
  for (int k = 0; k < count; ++k) {
    HandlePlace best;
    for (HandlePlace& c : candidates) {
      if (!places.empty() && places.back().disc == c.disc)
        c.radius = std::min(c.radius, (places.back().middle - c.middle).norm() - places.back().radius);
      if (c.radius > best.radius) best = c;
    }
    if (!(best.radius > 0)) throw std::invalid_argument("there is no room for so many handles");
    best.radius *= radius_of_room;
    places.push_back(best);
  }
  return places;
}

bool is_clockwise(const FlatDisc& disc) {
  double area = 0;
  for (std::size_t k = 0; k < disc.outline.size(); ++k) {
    const Vec2 &p = disc.outline[k], &q = disc.outline[(k + 1) % disc.outline.size()];
    area += p.x() * q.y() - p.y() * q.x();
  }
  return area < 0;
}

std::array<Vec2, 6> hexagon_of(const HandlePlace& place) {
  std::array<Vec2, 6> hexagon;
  for (int k = 0; k < 6; ++k) {
    const double angle = std::numbers::pi * (k / 3.0 - 0.5);
    hexagon[k] = place.middle + place.radius * Vec2(portable::cos(angle), portable::sin(angle));
  }
  return hexagon;
}

void add_handle(SpanningMesh& mesh, const std::array<Index, 6>& hexagon, const Vec3& down) {
  // Corners 0 and 3 are on the line between the halves; these lie one on the other's mirror image, corner by corner.
  const std::array<Index, 4> from{hexagon[0], hexagon[3], hexagon[4], hexagon[5]};
  const std::array<Index, 4> to{hexagon[0], hexagon[3], hexagon[2], hexagon[1]};
  std::array<Vec3, 4> start, end;
  Vec3 middle_of_start = Vec3::Zero(), middle_of_end = Vec3::Zero();
  for (int k = 0; k < 4; ++k) {
    middle_of_start += 0.25 * mesh.x[from[k]];
    middle_of_end += 0.25 * mesh.x[to[k]];
  }
  for (int k = 0; k < 4; ++k) {
    start[k] = middle_of_start + end_of_half * (mesh.x[from[k]] - middle_of_start);
    end[k] = middle_of_end + end_of_half * (mesh.x[to[k]] - middle_of_end);
  }
  std::vector<std::array<Index, 4>> rings;
  for (int i = 0; i <= segments_of_handle; ++i) {
    const double angle = std::numbers::pi * i / segments_of_handle;
    std::array<Index, 4>& ring = rings.emplace_back();
    for (int k = 0; k < 4; ++k) {
      const Vec3 across = 0.5 * (end[k] - start[k]);
      ring[k] = static_cast<Index>(mesh.x.size());
      mesh.x.push_back(start[k] + (1 - portable::cos(angle)) * across + portable::sin(angle) * across.norm() * down);
    }
  }
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    add_strip(mesh, from[k], from[next], rings.front()[k], rings.front()[next]);
    add_strip(mesh, to[next], to[k], rings.back()[next], rings.back()[k]);
    for (int i = 0; i < segments_of_handle; ++i)
      add_strip(mesh, rings[i][k], rings[i][next], rings[i + 1][k], rings[i + 1][next]);
  }
}

void cut_to_holes(FlatDisc& disc, std::vector<FlatDisc> holes) {
  const bool left = !is_clockwise(disc);
  while (!holes.empty()) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t at = 0, hole = 0, corner = 0;
    for (std::size_t h = 0; h < holes.size(); ++h)
      for (std::size_t k = 0; k < disc.outline.size(); ++k)
        for (std::size_t c = 0; c < holes[h].outline.size(); ++c) {
          const Vec2 &p = disc.outline[k], &q = holes[h].outline[c];
          const double length = (q - p).norm();
          if (length >= least || !begins_inside(disc, k, q, left) || bars(disc, p, q)) continue;
          if (std::any_of(holes.begin(), holes.end(), [&](const FlatDisc& other) { return bars(other, p, q); }))
            continue;
          least = length;
          at = k;
          hole = h;
          corner = c;
        }
    if (std::isinf(least)) throw NoSpanningStart("a hole is seen from no corner of its disc");
    FlatDisc& cut = holes[hole];
    const auto go_around = [&](auto& outline, auto& of_hole) {
      std::rotate(of_hole.begin(), of_hole.begin() + static_cast<std::ptrdiff_t>(corner), of_hole.end());
      of_hole.push_back(of_hole.front());
      of_hole.push_back(outline[at]);
      outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(at) + 1, of_hole.begin(), of_hole.end());
    };
    go_around(disc.corners, cut.corners);
    go_around(disc.outline, cut.outline);
    holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(hole));
  }
}

}  // namespace unsnarl
