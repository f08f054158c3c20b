#include "applications/isotopy/general_position.h"

#include <algorithm>
#include <limits>

#include "geometry/splitmix.h"

namespace unsnarl {
namespace {

/// How far a corner moves along each axis, at most [E281] (unit: distance of its edges to what they do not touch)
constexpr double shaken_by = 0.014;

/// The room of the edge after each corner: its distance to the nearest edge that does not touch it, and the distances
/// of the far ends of neighbouring edges to it, and of its own ends to them.
std::vector<double> room_of_edges(const Corners& c, const std::function<bool()>& stop) {
  const auto n = static_cast<Index>(c.x.cols());
  std::vector<double> room(n, std::numeric_limits<double>::infinity());
  for (Index v = 0; v < n && !stop(); ++v) {
    const Vec2 a = c.x.col(v), b = c.x.col(c.after[v]);
    const Vec2 low = a.cwiseMin(b), high = a.cwiseMax(b);
    for (Index w = 0; w < v; ++w) {
      const Vec2 p = c.x.col(w), q = c.x.col(c.after[w]);
      const double off = std::max((p.cwiseMin(q) - high).maxCoeff(), (low - p.cwiseMax(q)).maxCoeff());
      if (off >= room[v] && off >= room[w]) continue;
      double distance = std::numeric_limits<double>::infinity();
      // An end that both have is no distance.
      if (v != c.after[w]) distance = std::min({distance, distance_to_segment(a, p, q), distance_to_segment(q, a, b)});
      if (w != c.after[v]) distance = std::min({distance, distance_to_segment(b, p, q), distance_to_segment(p, a, b)});
      room[v] = std::min(room[v], distance);
      room[w] = std::min(room[w], distance);
    }
  }
  return room;
}

}  // namespace

Points2 in_general_position(const Corners& corners, const std::function<bool()>& stop) {
  const std::vector<double> room = room_of_edges(corners, stop);
  if (stop()) return corners.x;
  Points2 x = corners.x;
  for (Index v = 0; v < static_cast<Index>(x.cols()); ++v) {
    const double most = shaken_by * std::min(room[v], room[corners.before[v]]);
    for (int axis = 0; axis < 2; ++axis) {
      const double dice = splitmix_number((2 * static_cast<std::uint64_t>(v) + axis + 1) * splitmix_step);
      x(axis, v) += most * (2 * dice - 1);
    }
  }
  return x;
}

}  // namespace unsnarl
