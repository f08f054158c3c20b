#pragma once

#include <vector>

#include "applications/curves/curve_net.h"
#include "unsnarl/isotopy.h"

namespace unsnarl {

/// Polygons at one height: one a curve.
using Polygons = std::vector<Points2>;

/// An edge between two rings. Around the strip of triangles between them one point goes on by one from one rung to the
/// next, or both do.
using Rung = IsotopyRung;
/// Polygons of n points: quads, cut from point k to k + 1.
std::vector<Rung> straight_rungs(Index n);
/// A polygon below, and the finer one that `places` says lies on it: fans from the ends of its edges.
std::vector<Rung> rungs_to_finer(const std::vector<IsotopyPlace>& places, Index coarse_size);
/// The same the other way up.
std::vector<Rung> upside_down(std::vector<Rung> rungs);
/// A polygon below, and one above that lacks some of its points, no two of them neighbours. The lists say, ascending,
/// which point each is. From a point that is lacking, triangles lead to both of its neighbours: cut there, the polygon
/// stays within the triangle of the three.
std::vector<Rung> rungs_to_fewer(const std::vector<Index>& lower, const std::vector<Index>& upper);

/// Rings, each with the rungs that lead to it from the one below, one list a polygon.
struct Stack {
  std::vector<Polygons> rings;
  std::vector<std::vector<std::vector<Rung>>> rungs;  ///< one fewer than rings

  /// `from_last` has nothing for the first ring.
  void add(Polygons ring, std::vector<std::vector<Rung>> from_last);
  /// The rings of another stack but its first, which is the last one here.
  void add_above(Stack other);
  /// The first rings; size: [1, all].
  Stack first(std::size_t size) const;
  Stack upside_down() const;
};

/// The triangles of a strip, appended to the corners. `lower`, `upper`: the first vertices of both polygons.
void add_strip(const std::vector<Rung>& rungs, Index lower, Index upper, std::vector<std::int32_t>& corners);

/// A net of closed polygons: vertex k of it is the start of segment k.
CurveNet net_of(const Polygons& ring);
/// The points of all polygons, one after the other.
Points2 joined_points(const Polygons& ring);
/// The diagonal of the polygons' bounding box: a height at which strips above them are neither flat nor long.
double height_beside(const Polygons& ring);
/// Whether no two triangles of the strips between two rings of polygons of as many points intersect, decided exactly.
/// `net`: of a ring.
bool strips_are_embedded(const CurveNet& net, const Polygons& lower, const Polygons& upper, double height);

/// A subsequence of the rings, with the first and the last: from each ring the next one is as late as the strips to it
/// are embedded, found by doubling and halving. Strips between neighbouring rings are assumed to be embedded.
std::vector<std::size_t> thin_out(const std::vector<Polygons>& rings, double height);

}  // namespace unsnarl
