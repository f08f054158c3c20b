#include "applications/routes/moving_obstacles.h"

#include <algorithm>

namespace unsnarl {
namespace {

Vec3 offset_of(std::span<const RouteMove> motion, double time) {
  const auto after = std::find_if(motion.begin(), motion.end(), [&](const RouteMove& m) { return m.time > time; });
  if (after == motion.begin()) return vec(motion.front().offset);
  if (after == motion.end()) return vec(motion.back().offset);
  const RouteMove &a = *std::prev(after), &b = *after;
  const double share = (time - a.time) / (b.time - a.time);
  return vec(a.offset) + share * (vec(b.offset) - vec(a.offset));
}

}  // namespace

MovingObstacle::MovingObstacle(const RoutePlan& plan, int obstacle, Index steps) : triangles_(plan, obstacle) {
  const std::vector<RouteMove>& motion = plan.obstacles[static_cast<std::size_t>(obstacle)].motion;
  const double step = plan.duration / steps;
  for (Index k = 0; k < steps; ++k) {
    first_piece_.push_back(static_cast<Index>(pieces_.size()));
    std::vector<double> shares{0};
    for (const RouteMove& move : motion) {
      const double share = move.time / step - k;
      if (share > shares.back() && share < 1) shares.push_back(share);
    }
    shares.push_back(1);
    for (std::size_t m = 0; m + 1 < shares.size(); ++m)
      pieces_.push_back({shares[m], shares[m + 1], offset_of(motion, (k + shares[m]) * step),
                         offset_of(motion, (k + shares[m + 1]) * step)});
  }
  first_piece_.push_back(static_cast<Index>(pieces_.size()));
  for (const RouteMove& move : motion)
    for (const Vec3& end : {triangles_.bounds().lo, triangles_.bounds().hi})
      reach_.extend(Vec3(end + vec(move.offset)));
}

std::span<const MovingObstacle::Piece> MovingObstacle::pieces(Index step) const {
  return std::span(pieces_).subspan(first_piece_[step], first_piece_[step + 1] - first_piece_[step]);
}

bool MovingObstacle::is_clear(Index step, const Vec3& p, const Vec3& q, double distance) const {
  Box box;
  box.extend(p);
  box.extend(q);
  if (!box.inflated(distance).overlaps(reach_)) return true;
  for (const Piece& piece : pieces(step)) {
    const auto [a, b] = seen_in(piece, p, q);
    if (!triangles_.is_clear(a, b, distance)) return false;
  }
  return true;
}

std::vector<MovingObstacle> moving_obstacles(const RoutePlan& plan, Index steps) {
  std::vector<MovingObstacle> moving;
  for (std::size_t o = 0; o < plan.obstacles.size(); ++o)
    if (!plan.obstacles[o].motion.empty() && plan.obstacles[o].surface.view().face_count() > 0)
      moving.emplace_back(plan, static_cast<int>(o), steps);
  return moving;
}

std::array<Vec3, 2> seen_in(const MovingObstacle::Piece& piece, const Vec3& p, const Vec3& q) {
  return {p + piece.from * (q - p) - piece.offset_from, p + piece.to * (q - p) - piece.offset_to};
}

}  // namespace unsnarl
