#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// How deep two convex polygons A and B overlap: the distance of the origin to the boundary of A - B
/// (Minarčík, Liu, Crane, Li: Untangling Surfaces via Shape and Mesh Repulsion, §3.2, eq. (8); the sign is turned, so
/// that the penalty (10) is max(0, depth)).
///
/// `margin` is added to the depth: with a margin, polygons closer than it count as overlapping too.
struct Penetration {
  double depth = 0;            ///< > 0: overlap, or closer than the margin. <= 0: separated (a bound, not a distance)
  Vec3 normal = Vec3::Zero();  ///< unit where depth > 0; moving A by +depth * normal separates the two
  /// Barycentric weights of the foot points on the supporting features; each sums to 1.
  /// d(depth)/d(a_i) = -normal * weight_a[i], d(depth)/d(b_j) = +normal * weight_b[j]: exact where the active normal
  /// is a face normal or edge x edge, which without a margin is always so.
  std::array<double, 3> weight_a{};
  std::array<double, 3> weight_b{};
};

/// Candidate normals: both face normals and all edge x edge, either sign. With a margin > 0 also the in-plane ones
/// (face normal x edge): without these coplanar neighbours that lie side by side would look like contacts.
/// Works on degenerate triangles (segments, points) as far as candidate normals exist; otherwise reports none.
/// `hint` (optional): in, the normal to try first; out, one that separates, if any does. A pair that stays separated
/// then costs one normal instead of up to 17; what is reported where depth > 0 does not depend on it.
Penetration triangle_penetration(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double margin,
                                 std::uint8_t* hint = nullptr);

/// Depth of the overlap of two triangles at x, without margin.
double overlap_depth(const Positions& x, const Triangle& a, const Triangle& b);

/// The same for planar convex polygons with three corners or more, in order around. The weights go to the caller's
/// arrays, one entry a corner; they are written only where depth > 0.
struct PolygonPenetration {
  double depth = 0;
  Vec3 normal = Vec3::Zero();
};
PolygonPenetration polygon_penetration(std::span<const Vec3> a, std::span<const Vec3> b, double margin,
                                       std::span<double> weight_a, std::span<double> weight_b);

/// Two triangles that share exactly one vertex, which is corner `shared_a` of a and `shared_b` of b: each has its
/// shared corner pulled the fraction `trim` towards the middle of the opposite edge, and what remains is tested as
/// above. The weights refer to the untrimmed corners.
Penetration one_vertex_penetration(const std::array<Vec3, 3>& a, int shared_a, const std::array<Vec3, 3>& b,
                                   int shared_b, double trim, double margin, std::uint8_t* hint = nullptr);

/// Two triangles (u, v, p) and (u, v, q) on a common edge, folded onto each other. Depth > 0 where p and q lie on the
/// same side of the edge and the lower of them is closer than the opening wanted to the plane of the other triangle.
/// The opening is `margin`, but never more than `max_slope` times the height of the lower one above the edge.
/// A fold that is exactly flat opens towards `flat_side` (+1 or -1) of the normal of the triangle that is higher.
/// weight_a belongs to (u, v, p), weight_b to (u, v, q).
Penetration fold_penetration(const Vec3& u, const Vec3& v, const Vec3& p, const Vec3& q, double margin,
                             double max_slope, int flat_side = 1);

struct MinkowskiOptions {
  double margin = 0;  ///< length, >= 0: penalised until the faces are this far apart
  /// Faces that share a vertex are trimmed there by this share of their height [E177] (no unit)
  double vertex_trim = 0.1;
  /// A fold counts as open at this slope, rise over run, where the margin would need more, as in thin triangles (no
  /// unit)
  double fold_slope = 0.25;
  bool one_vertex = true;  ///< penalise pairs that share one vertex
  bool folded = true;      ///< penalise pairs that share an edge
};

/// E_M (paper eq. (10)): the sum of max(0, depth) over a list of pairs of triangles, each by the rule for the number of
/// vertices that it shares; pairs on the same three vertices contribute nothing.
class MinkowskiPenalty {
 public:
  /// The spans must outlive the energy.
  MinkowskiPenalty(std::span<const Triangle> triangles, const MinkowskiOptions& options)
      : triangles_(triangles), options_(options) {}

  using Pair = std::array<Index, 2>;
  /// Candidate pairs of triangles, a != b: at least those whose boxes, inflated by half the margin, overlap.
  std::vector<Pair> pairs;

  /// Returns weight * E_M and adds weight * its gradient. Same bits at any thread count.
  double value_and_gradient(const Positions& x, Positions& gradient, double weight = 1);

  /// The penalty of one pair; weights in the order of the triangles' corners.
  Penetration evaluate(const Positions& x, Index a, Index b, std::uint8_t* hint = nullptr) const;

 private:
  struct Contact {
    Index a, b;
    Penetration penetration;
  };
  std::vector<std::uint8_t> hints_;
  std::vector<std::vector<Contact>> contacts_;
  std::span<const Triangle> triangles_;
  MinkowskiOptions options_;
};

}  // namespace unsnarl
