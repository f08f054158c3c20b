#include "applications/seifert/embedded_mesh.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "contact/distances.h"
#include "geometry/portable_math.h"
#include "geometry/predicates.h"
#include "geometry/sort_unique.h"
#include "geometry/triangle_intersection.h"

namespace unsnarl {
namespace {

/// The gap that is asked of two triangles, at most, since those of one sheet are near each other (unit: their shortest
/// edge)
constexpr double gap_of_edge = 0.3;
/// Faces of a needle that is cut off, at most (unit: faces)
constexpr std::size_t most_faces_cut_off = 300;
/// A fold is sharp where one plus the inner product of the normals is below this, 20 degrees between the faces (no
/// unit)
constexpr double sharp_fold = 0.06;
/// A triangle is thin where its smallest height is below this (unit: its longest edge)
constexpr double thin = 0.05;
/// A flip must raise the smallest angle by this, so that edges do not flip to and fro (unit: radian)
constexpr double angle_gain = 0.05;

/// The clearance of faces that intersect (no unit)
constexpr double intersecting = -1;

double shortest_edge(const TrianglePoints& t) {
  return std::sqrt(std::min({(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm()}));
}

double squared_distance(const TrianglePoints& a, const TrianglePoints& b) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, squared_distance(StencilKind::vertex_face, {a[i], b[0], b[1], b[2]}));
    least = std::min(least, squared_distance(StencilKind::vertex_face, {b[i], a[0], a[1], a[2]}));
    for (int j = 0; j < 3; ++j)
      least = std::min(least, squared_distance(StencilKind::edge_edge, {a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]}));
  }
  return least;
}

/// Whether there is this much room between the triangles along the axis, b beyond a, or on either side: whatever is
/// rounded, since the difference of two points and its product with the axis are off by a few roundings of the
/// magnitudes that they are made of.
enum class Order { beyond, either };
bool are_separated_along(const Vec3& axis, const TrianglePoints& a, const TrianglePoints& b, double room,
                         Order order = Order::beyond) {
  /// Relative error of a handful of operations that each round once (fixed by float64)
  constexpr double few_roundings = 16 * detail::half_ulp;
  const Vec3 origin = a[0], size = axis.cwiseAbs();
  const double a1 = axis.dot(a[1] - origin), a2 = axis.dot(a[2] - origin);
  const double b0 = axis.dot(b[0] - origin), b1 = axis.dot(b[1] - origin), b2 = axis.dot(b[2] - origin);
  double between = std::min({b0, b1, b2}) - std::max({0.0, a1, a2});
  if (order == Order::either) between = std::max(between, std::min({0.0, a1, a2}) - std::max({b0, b1, b2}));
  if (!(between > room)) return false;
  double magnitude = 0;
  for (int k = 0; k < 3; ++k) magnitude = std::max(magnitude, size.dot(a[k].cwiseAbs()) + size.dot(b[k].cwiseAbs()));
  magnitude += size.dot(origin.cwiseAbs());
  return magnitude > detail::underflow_guard && between > room + few_roundings * magnitude;
}

/// Whether a plane through the first corner, which both have, has the rest of one triangle on one side and that of the
/// other one on the other: cheap, and true of most that have one corner alone in common. Never true of triangles that
/// meet elsewhere, whatever is rounded.
bool are_on_two_sides(const TrianglePoints& a, const TrianglePoints& b) {
  const auto middle = [](const TrianglePoints& t) -> Vec3 {
    return (t[1] - t[0]).normalized() + (t[2] - t[0]).normalized();
  };
  const Vec3 axis = middle(b) - middle(a);
  return are_separated_along(axis, {a[0], a[1], a[2]}, {b[1], b[1], b[2]}, 0) &&
         are_separated_along(axis, {a[1], a[1], a[2]}, {b[0], b[1], b[2]}, 0);
}

double smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto angle = [](const Vec3& p, const Vec3& q, const Vec3& r) {
    return portable::atan2((q - p).cross(r - p).norm(), (q - p).dot(r - p));
  };
  return std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
}

Triangle rotated(const Triangle& t, int first) {
  return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
}

int place_of(const Triangle& t, Index v) {
  return t[0] == v ? 0 : t[1] == v ? 1 : t[2] == v ? 2 : -1;
}

}  // namespace

bool are_separated(const TrianglePoints& a, const TrianglePoints& b, double by) {
  for (const auto& [s, t] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const Vec3 normal = ((*s)[1] - (*s)[0]).cross((*s)[2] - (*s)[0]);
    if (are_separated_along(normal, *s, *t, by * normal.norm(), Order::either)) return true;
    for (int k = 0; k < 3; ++k) {
      const Vec3 out = ((*s)[(k + 1) % 3] - (*s)[k]).cross(normal);
      if (are_separated_along(out, *s, *t, by * out.norm())) return true;
    }
  }
  return false;
}

EmbeddedMesh::EmbeddedMesh(SpanningMesh mesh, Index boundary_count, double edge, double gap)
    : x_(std::move(mesh.x)), faces_of_(x_.size()), boundary_count_(boundary_count), gap_(gap), grid_([&] {
        Vec3 lo = x_[0], hi = x_[0];
        for (const Vec3& p : x_) {
          lo = lo.cwiseMin(p);
          hi = hi.cwiseMax(p);
        }
        return FaceGrid(lo, hi, edge);
      }()) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    faces_.push_back({-1, -1, -1});
    is_without_.push_back(0);
    put(static_cast<Index>(f), mesh.faces[f]);
  }
}

void EmbeddedMesh::put(Index face, const Triangle& t) {
  faces_[face] = t;
  ++living_faces_;
  for (const Index v : t) faces_of_[v].push_back(face);
  const Vec3 &a = x_[t[0]], &b = x_[t[1]], &c = x_[t[2]];
  grid_.insert(face, a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c));
}

void EmbeddedMesh::erase(Index face) {
  for (const Index v : faces_[face]) std::erase(faces_of_[v], face);
  faces_[face] = {-1, -1, -1};
  --living_faces_;
  grid_.remove(face);
}

void EmbeddedMesh::replace(std::span<const Index> old_faces, std::span<const Triangle> new_faces) {
  const std::vector<Index> old(old_faces.begin(), old_faces.end());
  for (const Index f : old) {
    erase(f);
    free_faces_.push_back(f);
  }
  for (const Triangle& t : new_faces) {
    if (free_faces_.empty()) {
      free_faces_.push_back(static_cast<Index>(faces_.size()));
      faces_.push_back({-1, -1, -1});
      is_without_.push_back(0);
    }
    const Index f = free_faces_.back();
    free_faces_.pop_back();
    put(f, t);
  }
}

std::vector<Edge> EmbeddedMesh::interior_edges() const {
  std::vector<Edge> edges;
  for (const Triangle& t : faces_)
    if (t[0] >= 0)
      for (int k = 0; k < 3; ++k) edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> interior;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
    if (edges[k] == edges[k + 1]) interior.push_back(edges[k]);
  return interior;
}

std::array<Index, 2> EmbeddedMesh::faces_at(const Edge& edge) const {
  std::array<Index, 2> found{-1, -1};
  int count = 0;
  for (const Index f : faces_of_[edge[0]])
    if (place_of(faces_[f], edge[1]) >= 0 && count < 2) found[count++] = f;
  return found;
}

std::vector<Index> EmbeddedMesh::neighbours(Index v) const {
  std::vector<Index> result;
  for (const Index f : faces_of_[v])
    for (const Index w : faces_[f])
      if (w != v) result.push_back(w);
  sort_unique(result);
  return result;
}

Vec3 EmbeddedMesh::normal(const Triangle& t) const {
  return (x_[t[1]] - x_[t[0]]).cross(x_[t[2]] - x_[t[0]]);
}

double EmbeddedMesh::squared_longest_edge(const Triangle& t) const {
  double longest = 0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, (x_[t[(k + 1) % 3]] - x_[t[k]]).squaredNorm());
  return longest;
}

double EmbeddedMesh::soundness_of(const Triangle& t) const {
  const double area = normal(t).norm(), longest = squared_longest_edge(t);
  return longest > 0 ? area / longest / thin : -1;
}

double EmbeddedMesh::soundness_of_pair(const Triangle& a, const Triangle& b, double gap, double below) const {
  const auto points = [&](const Triangle& t) { return TrianglePoints{x_[t[0]], x_[t[1]], x_[t[2]]}; };
  std::array<int, 3> shared{};
  int count = 0;
  for (int k = 0; k < 3; ++k)
    if (place_of(b, a[k]) >= 0) shared[count++] = k;
  if (count == 3) return -1;
  if (count == 0) {
    const TrianglePoints p = points(a), q = points(b);
    const double wanted = std::min(gap, gap_of_edge * std::min(shortest_edge(p), shortest_edge(q)));
    if (are_separated(p, q, std::max(below, 0.0) * wanted)) return 1;
    if (triangles_meet(p, q) != Meeting::no) return -1;
    return wanted > 0 ? std::sqrt(squared_distance(p, q)) / wanted : 1;
  }
  if (count == 1) {
    const Triangle s = rotated(a, shared[0]), t = rotated(b, place_of(b, s[0]));
    if (are_on_two_sides(points(s), points(t))) return 1;
    return triangles_meet_beyond_vertex(points(s), points(t)) == Meeting::no ? 1 : -1;
  }
  const int first = (shared[0] + 1) % 3 == shared[1] ? shared[0] : shared[1];
  const Triangle s = rotated(a, first), t = rotated(b, place_of(b, s[1]));  // the edge runs the other way in b
  if (t[1] != s[0]) return -1;
  const Vec3 m = normal(s), n = normal(t);
  const double cosine = m.dot(n) / std::max(m.norm() * n.norm(), std::numeric_limits<double>::min());
  const Triangle same = {t[1], t[0], t[2]};
  if (triangles_fold_flat(points(s), points(same)) != Meeting::no) return -1;
  return (1 + cosine) / sharp_fold;
}

double EmbeddedMesh::shape(std::span<const Triangle> faces) const {
  double result = 1;
  for (const Triangle& t : faces) result = std::min(result, soundness_of(t));
  return result;
}

double EmbeddedMesh::clearance(std::span<const Triangle> faces, std::span<const Index> without, double gap,
                               double enough) {
  for (const Index f : without) is_without_[f] = 1;
  double result = 1;
  for (std::size_t i = 0; i < faces.size() && result > enough; ++i) {
    const Triangle& t = faces[i];
    for (std::size_t j = i + 1; j < faces.size() && result > enough; ++j)
      result = std::min(result, soundness_of_pair(t, faces[j], gap, result));
    const double reach = std::min(gap, gap_of_edge * shortest_edge({x_[t[0]], x_[t[1]], x_[t[2]]}));
    const Vec3 lo = (x_[t[0]].cwiseMin(x_[t[1]]).cwiseMin(x_[t[2]]).array() - reach).matrix();
    const Vec3 hi = (x_[t[0]].cwiseMax(x_[t[1]]).cwiseMax(x_[t[2]]).array() + reach).matrix();
    grid_.query(lo, hi, [&](Index f) {
      if (result <= enough || is_without_[f]) return;
      const Triangle& other = faces_[f];
      const Vec3 &a = x_[other[0]], &b = x_[other[1]], &c = x_[other[2]];
      for (int k = 0; k < 3; ++k)
        if (std::min({a[k], b[k], c[k]}) > hi[k] || std::max({a[k], b[k], c[k]}) < lo[k]) return;
      result = std::min(result, soundness_of_pair(t, other, gap, result));
    });
  }
  for (const Index f : without) is_without_[f] = 0;
  return result;
}

bool EmbeddedMesh::is_improved(std::span<const Triangle> before, std::span<const Triangle> after,
                               std::span<const Index> old, Index v, const Vec3& to) {
  const Vec3 from = x_[v];
  const auto at = [&](const Vec3& place, const auto& measure) {
    x_[v] = place;
    const double result = measure();
    x_[v] = from;
    return result;
  };
  const double shaped = at(to, [&] { return shape(after); });
  if (shaped < 0 || (shaped < 1 && shaped < shape(before))) return false;
  const double cleared = at(to, [&] { return clearance(after, old, gap_, intersecting); });
  return cleared >= 1 || (cleared >= 0 && cleared >= clearance(before, old, gap_, cleared));
}

bool EmbeddedMesh::move(Index v, const Vec3& to) {
  const std::vector<Index> star = faces_of_[v];
  std::vector<Triangle> faces;
  for (const Index f : star) faces.push_back(faces_[f]);
  if (!is_improved(faces, faces, star, v, to)) return false;
  x_[v] = to;
  for (std::size_t k = 0; k < star.size(); ++k) {
    grid_.remove(star[k]);
    const Vec3 &a = x_[faces[k][0]], &b = x_[faces[k][1]], &c = x_[faces[k][2]];
    grid_.insert(star[k], a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c));
  }
  return true;
}

bool EmbeddedMesh::split(const Edge& edge) {
  const std::array<Index, 2> old = faces_at(edge);
  if (old[1] < 0) return false;
  const auto middle = static_cast<Index>(x_.size());
  x_.push_back(0.5 * (x_[edge[0]] + x_[edge[1]]));
  std::vector<Triangle> faces;
  bool becomes_thin = false;
  for (const Index f : old) {
    const Triangle t = faces_[f];
    const bool is_longest = squared_longest_edge(t) == (x_[edge[1]] - x_[edge[0]]).squaredNorm();
    for (const Index end : edge) {
      Triangle half = t;
      half[place_of(t, end)] = middle;
      faces.push_back(half);
      becomes_thin |= !is_longest && soundness_of(half) < 1;
    }
  }
  // The halves cover what was there, but for rounding: gaps stay as they are.
  faces_of_.emplace_back();
  if (becomes_thin || shape(faces) < 0 || clearance(faces, old, 0, intersecting) < 0) {
    x_.pop_back();
    faces_of_.pop_back();
    return false;
  }
  replace(old, faces);
  return true;
}

bool EmbeddedMesh::collapse(const Edge& edge, double longest) {
  const bool first_is_boundary = edge[0] < boundary_count_, second_is_boundary = edge[1] < boundary_count_;
  if (first_is_boundary && second_is_boundary) return false;
  const Index kept = second_is_boundary ? edge[1] : edge[0], gone = second_is_boundary ? edge[0] : edge[1];
  const std::array<Index, 2> between = faces_at(edge);
  if (between[1] < 0) return false;
  const std::vector<Index> of_kept = neighbours(kept), of_gone = neighbours(gone);
  std::vector<Index> common;
  std::set_intersection(of_kept.begin(), of_kept.end(), of_gone.begin(), of_gone.end(), std::back_inserter(common));
  if (common.size() != 2) return false;
  if (faces_of_[kept].size() + faces_of_[gone].size() < 6) return false;
  const bool stays = kept < boundary_count_;
  std::vector<Index> old = faces_of_[gone];
  if (!stays)
    for (const Index f : faces_of_[kept])
      if (f != between[0] && f != between[1]) old.push_back(f);
  std::vector<Triangle> faces, before;
  for (const Index f : old) {
    before.push_back(faces_[f]);
    if (f == between[0] || f == between[1]) continue;
    Triangle t = faces_[f];
    if (const int k = place_of(t, gone); k >= 0) t[k] = kept;
    faces.push_back(t);
  }
  const Vec3 from = x_[kept];
  const Vec3 to = stays ? from : Vec3(0.5 * (x_[kept] + x_[gone]));
  for (const Index v : of_gone)
    if (v != kept && (x_[v] - to).norm() > std::max(longest, (x_[v] - x_[gone]).norm())) return false;
  if (!is_improved(before, faces, old, kept, to)) return false;
  for (const Index f : old) {
    erase(f);
    free_faces_.push_back(f);
  }
  x_[kept] = to;
  replace({}, faces);
  return true;
}

bool EmbeddedMesh::flip(const Edge& edge) {
  const std::array<Index, 2> old = faces_at(edge);
  if (old[1] < 0) return false;
  const Triangle s = rotated(faces_[old[0]], place_of(faces_[old[0]], edge[0]));
  const bool forward = s[1] == edge[1];
  const Index a = edge[0], b = edge[1], c = forward ? s[2] : s[1];
  Index d = -1;
  for (const Index v : faces_[old[1]])
    if (v != a && v != b) d = v;
  if (c == d) return false;
  const std::vector<Index> of_c = neighbours(c);
  if (std::binary_search(of_c.begin(), of_c.end(), d)) return false;
  const double before = std::min(smallest_angle(x_[a], x_[b], x_[c]), smallest_angle(x_[a], x_[b], x_[d]));
  const double after = std::min(smallest_angle(x_[a], x_[d], x_[c]), smallest_angle(x_[d], x_[b], x_[c]));
  if (after < before + angle_gain) return false;
  const std::array<Triangle, 2> faces = forward ? std::array<Triangle, 2>{Triangle{a, d, c}, Triangle{d, b, c}}
                                                : std::array<Triangle, 2>{Triangle{d, a, c}, Triangle{b, d, c}};
  const std::array<Triangle, 2> was{faces_[old[0]], faces_[old[1]]};
  if (!is_improved(was, faces, old, a, x_[a])) return false;
  replace(old, faces);
  return true;
}

bool EmbeddedMesh::cut_off(const Edge& edge) {
  const std::array<Index, 2> beside = faces_at(edge);
  if (beside[1] < 0) return false;
  const std::vector<Index> of_a = neighbours(edge[0]), of_b = neighbours(edge[1]);
  std::vector<Index> common;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
  for (const Index c : common) {
    if (place_of(faces_[beside[0]], c) >= 0 || place_of(faces_[beside[1]], c) >= 0) continue;
    for (const Index first : beside) {
      const std::vector<Index> disc = disc_within({edge[0], edge[1], c}, first);
      if (disc.empty()) continue;
      // The triangle runs along the edge as the face beside it that goes.
      const Triangle& t = faces_[first];
      const bool is_forward = t[(place_of(t, edge[0]) + 1) % 3] == edge[1];
      const std::array<Triangle, 1> lid{is_forward ? Triangle{edge[0], edge[1], c} : Triangle{edge[1], edge[0], c}};
      std::vector<Triangle> before;
      for (const Index f : disc) before.push_back(faces_[f]);
      if (!is_improved(before, lid, disc, edge[0], x_[edge[0]])) continue;
      replace(disc, lid);
      return true;
    }
  }
  return false;
}

std::vector<Index> EmbeddedMesh::disc_within(const Triangle& around, Index first) const {
  std::vector<Index> faces{first};
  std::set<Index> seen{first}, vertices;
  std::set<Edge> edges;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Triangle& t = faces_[faces[k]];
    for (int i = 0; i < 3; ++i) {
      const Edge edge{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])};
      vertices.insert(t[i]);
      edges.insert(edge);
      if (place_of(around, edge[0]) >= 0 && place_of(around, edge[1]) >= 0) continue;
      const std::array<Index, 2> beside = faces_at(edge);
      if (beside[1] < 0) return {};
      for (const Index f : beside)
        if (seen.insert(f).second) faces.push_back(f);
    }
    if (faces.size() > most_faces_cut_off) return {};
  }
  const auto euler = static_cast<Index>(vertices.size() + faces.size()) - static_cast<Index>(edges.size());
  return euler == 1 ? faces : std::vector<Index>{};
}

SpanningMesh EmbeddedMesh::compact() const {
  SpanningMesh mesh;
  std::vector<Index> id(x_.size(), -1);
  for (Index v = 0; v < vertex_count(); ++v)
    if (v < boundary_count_ || is_alive(v)) {
      id[v] = static_cast<Index>(mesh.x.size());
      mesh.x.push_back(x_[v]);
    }
  for (const Triangle& t : faces_)
    if (t[0] >= 0) mesh.faces.push_back({id[t[0]], id[t[1]], id[t[2]]});
  return mesh;
}

}  // namespace unsnarl
