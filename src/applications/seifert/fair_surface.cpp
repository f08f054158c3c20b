#include "applications/seifert/fair_surface.h"

#include <algorithm>
#include <cmath>

namespace unsnarl {
namespace {

/// Longer edges are split. Half of them is above collapse_below: M. Botsch and L. Kobbelt, "A Remeshing Approach to
/// Multiresolution Modeling", 2004 (unit: wanted length)
constexpr double split_above = 4.0 / 3;
/// Shorter edges are collapsed; double of them is below split_above (unit: wanted length)
constexpr double collapse_below = 0.6;
constexpr double least_sine = 1e-12;  ///< Sines in cotangents are this at least (no unit)
/// Weight of the area's gradient at an edge, at least: cotangents of slivers may be negative (no unit)
constexpr double least_weight = 0.05;
/// Weight of the area's gradient at an edge, at most: cotangents of slivers have no bound (no unit)
constexpr double largest_weight = 5;
/// Vertices that want to go no farther are left alone (unit: wanted edge length)
constexpr double settled = 6e-3;
/// Where the vector area of the faces around a vertex is below this, they are folded and have no normal: the vertex
/// goes all of its way, not across and along the surface apart [E256] (unit: their area)
constexpr double folded_below = 0.4;
/// Share of a step that is tried where the whole one fails (no unit)
constexpr double shorter_step = 0.3;
/// Rounds of splitting, at most; each halves what is too long (unit: rounds)
constexpr int most_split_rounds = 8;

double length(const EmbeddedMesh& mesh, const Edge& e) {
  return (mesh.position(e[0]) - mesh.position(e[1])).norm();
}

/// Whether to go on, asked at every `often`-th step.
class Pace {
 public:
  explicit Pace(const std::function<bool()>& goes_on) : goes_on_(goes_on) {}
  bool operator()() {
    if (++steps_ % often == 0) is_over_ = is_over_ || !goes_on_();
    return !is_over_;
  }

 private:
  static constexpr int often = 64;  ///< Steps between two questions whether to go on (unit: steps)
  const std::function<bool()>& goes_on_;
  int steps_ = 0;
  bool is_over_ = false;
};

void collapse_short_edges(EmbeddedMesh& mesh, double edge, Pace& pace) {
  for (const Edge& e : mesh.interior_edges()) {
    if (!pace()) return;
    if (!mesh.is_alive(e[0]) || !mesh.is_alive(e[1]) || length(mesh, e) > collapse_below * edge) continue;
    if (!mesh.collapse(e, split_above * edge)) mesh.cut_off(e);  // [E282]
  }
}

/// Short edges go before long ones are split, so that thousands of needles beside a fine boundary become few first.
void remesh(EmbeddedMesh& mesh, double edge, Pace& pace) {
  for (int round = 0; round < most_split_rounds; ++round) {
    collapse_short_edges(mesh, edge, pace);
    bool any = false;
    for (const Edge& e : mesh.interior_edges())
      if (pace() && length(mesh, e) > split_above * edge) any |= mesh.split(e);
    if (!any) break;
  }
  for (const Edge& e : mesh.interior_edges())
    if (pace()) mesh.flip(e);
}

double cotangent(const Vec3& corner, const Vec3& a, const Vec3& b) {
  const Vec3 u = a - corner, v = b - corner;
  return u.dot(v) / std::max(u.cross(v).norm(), least_sine * u.norm() * v.norm());
}

/// The bend at an edge ab between faces with third corners c and d is c + d - a - b: where triangles are equilateral,
/// as long as their height times the angle between them. The sum of its squares over edges around a vertex is least
/// where the vertex goes by arrow / count (the quadratic bending energy of M. Bergou, M. Wardetzky, D. Harmon, D. Zorin
/// and E. Grinspun, "A Quadratic Bending Model for Inextensible Surfaces", 2006, for equal triangles).
struct Bends {
  Vec3 arrow = Vec3::Zero();
  double count = 0;  ///< edges
};

/// Sums the bends at all edges inside the surface that end at the vertex or lie opposite to it. Edges that end at the
/// boundary's vertices are among them.
Bends bends_around(const EmbeddedMesh& mesh, Index v) {
  Bends bends;
  const Vec3 p = mesh.position(v);
  // Inside the surface, every edge that ends at the vertex is in two faces.
  for (const Index f : mesh.faces_of(v)) {
    const Triangle& t = mesh.face(f);
    const int k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
    const Index a = t[(k + 1) % 3], b = t[(k + 2) % 3];
    const Vec3 ends = mesh.position(a) + mesh.position(b);
    bends.arrow += 0.5 * ends - p;
    bends.count += 1;
    const std::array<Index, 2> beside = mesh.faces_at({a, b});
    if (beside[1] < 0) continue;
    for (const Index w : mesh.face(beside[0] == f ? beside[1] : beside[0]))
      if (w != a && w != b) bends.arrow += ends - p - mesh.position(w);
    bends.count += 1;
  }
  return bends;
}

/// The target of a vertex: along the normal the place where area and bends around it are least, along the surface the
/// middle of its neighbours.
Vec3 wanted(const EmbeddedMesh& mesh, Index v, const FairOptions& options) {
  const Vec3 p = mesh.position(v);
  Vec3 normal = Vec3::Zero(), pull = Vec3::Zero(), middle = Vec3::Zero();
  double weights = 0, areas = 0;
  for (const Index f : mesh.faces_of(v)) {
    const Triangle& t = mesh.face(f);
    const int k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
    const Vec3 &a = mesh.position(t[(k + 1) % 3]), &b = mesh.position(t[(k + 2) % 3]);
    const Vec3 doubled = (a - p).cross(b - p);
    normal += doubled;
    const double area = doubled.norm();
    middle += area * (p + a + b) / 3;
    areas += area;
    for (const auto& [end, corner, other] : {std::array<Vec3, 3>{a, b, p}, std::array<Vec3, 3>{b, a, p}}) {
      const double w = std::clamp(cotangent(corner, end, other), least_weight, largest_weight);
      pull += w * (end - p);
      weights += w;
    }
  }
  if (!(areas > 0) || !(weights > 0)) return p;
  const double norm = normal.norm();
  const Vec3 n = norm > 0 ? Vec3(normal / norm) : Vec3(Vec3::Zero());
  const Vec3 along = middle / areas - p;
  const Bends bends = bends_around(mesh, v);
  const Vec3 across = (pull / weights + options.bending * bends.arrow) / (1 + options.bending * bends.count);
  if (norm < folded_below * areas) return p + across;
  return p + options.over_relaxation * across.dot(n) * n + (along - along.dot(n) * n);
}

}  // namespace

SpanningMesh fair(SpanningMesh start, Index boundary_count, double edge, const FairOptions& options,
                  const std::function<void(double)>& progress, const std::function<bool()>& goes_on) {
  Pace pace(goes_on);
  const int all = options.sweeps * options.levels * (options.levels + 1) / 2;
  int done = 0;
  for (int level = options.levels - 1; level >= 0; --level) {
    const double wished = edge * (1 << level);
    EmbeddedMesh mesh(std::move(start), boundary_count, wished, options.gap_of_edge * wished);
    for (int sweep = 0; sweep < options.sweeps * (level + 1); ++sweep, ++done) {
      progress(static_cast<double>(done) / all);
      if (!goes_on()) return mesh.compact();
      if (sweep % options.sweeps_a_remeshing == 0) remesh(mesh, wished, pace);
      const Index n = mesh.vertex_count();
      for (Index k = boundary_count; k < n && pace(); ++k) {
        const Index v = sweep % 2 == 0 ? k : n - 1 - (k - boundary_count);  // to and fro
        if (!mesh.is_alive(v)) continue;
        const Vec3 from = mesh.position(v), to = wanted(mesh, v, options);
        if ((to - from).norm() < settled * wished) continue;
        if (!mesh.move(v, to)) mesh.move(v, from + shorter_step * (to - from));
      }
    }
    start = mesh.compact();
  }
  return start;
}

}  // namespace unsnarl
