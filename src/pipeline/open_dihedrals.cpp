#include "pipeline/open_dihedrals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "contact/smallest_gap.h"
#include "mesh/areas.h"
#include "mesh/dihedral_angles.h"

namespace unsnarl {
namespace {

/// Hinges are opened to this multiple of the wanted angle, so that rounding and neighbours leave enough (no unit)
constexpr double reserve = 1.05;
constexpr int most_rounds = 100;  ///< Rounds of opening hinges, at most [E185] (unit: rounds)
/// Longest motion of a vertex in one round; angles are far from linear in longer steps (unit: least height of a face at
/// the vertex)
constexpr double most_of_height = 0.25;

/// Gradient of the angle at a hinge by its corners a, b, c, d: the third corners move across their faces, and the edge
/// takes up what keeps forces and torques in balance. False where a face has no area.
bool angle_gradient(const Positions& x, const Hinge& hinge, std::array<Vec3, 4>& gradient) {
  const Vec3 edge = x.col(hinge.b) - x.col(hinge.a);
  const Vec3 first = x.col(hinge.c) - x.col(hinge.a), second = x.col(hinge.d) - x.col(hinge.a);
  const Vec3 u = edge.cross(first), w = edge.cross(second);
  const double squared = edge.squaredNorm(), length = std::sqrt(squared);
  if (!(squared > 0) || !(u.squaredNorm() > 0) || !(w.squaredNorm() > 0)) return false;
  // Which way round the first half-plane turns into the second; where they coincide, either way opens them.
  const double side = u.cross(w).dot(edge) >= 0 ? 1 : -1;
  // The angle grows as the first corner turns against that way and the second with it.
  const Vec3 by_c = -side * length / u.squaredNorm() * u, by_d = side * length / w.squaredNorm() * w;
  const double share_c = first.dot(edge) / squared, share_d = second.dot(edge) / squared;
  gradient = {-(1 - share_c) * by_c - (1 - share_d) * by_d, -share_c * by_c - share_d * by_d, by_c, by_d};
  return true;
}

/// Which of the four vertices of a hinge turn it, and how much of the way. What is blocked one way may be free another:
/// where a round brings nothing, the next way is tried, and the last one has failed where all have in a row.
struct Way {
  std::array<bool, 4> moves;  // a, b, c, d
  double share;
};
/// The last way turns a hinge by this share of what is missing (no unit)
constexpr double small_share = 0.1;
constexpr std::array<Way, 6> ways = {{{{true, true, true, true}, 1},
                                      {{false, false, true, true}, 1},
                                      {{false, false, true, false}, 1},
                                      {{false, false, false, true}, 1},
                                      {{true, true, false, false}, 1},
                                      {{true, true, true, true}, small_share}}};

class Opening {
 public:
  Opening(Scene& scene, const OpenDihedralsOptions& options)
      : scene_(scene), options_(options), hinges_(hinges_of(scene.triangles)) {}

  std::size_t run() {
    std::vector<std::size_t> closed = closed_hinges();
    if (closed.empty()) return 0;
    tolerated_ = options_.pairs_at(scene_.x);
    tolerated_near_ = near_pairs();
    std::size_t way = 0, failed = 0;
    for (int round = 0; round < most_rounds && failed < ways.size() && !closed.empty() && !options_.stop(); ++round) {
      const Positions before = scene_.x;
      turn(closed, ways[way]);
      keep_near();
      scene_.x = options_.as_written(scene_.x);
      take_back_new_pairs(before);
      const std::size_t were_closed = closed.size();
      if (scene_.x != before) closed = closed_hinges();
      failed = closed.size() < were_closed ? 0 : failed + 1;
      if (failed > 0) way = (way + 1) % ways.size();
    }
    return closed.size();
  }

 private:
  std::vector<std::size_t> closed_hinges() const {
    std::vector<std::size_t> closed;
    for (std::size_t i = 0; i < hinges_.size(); ++i) {
      const HingeAngle angle = hinge_angle(scene_.x, hinges_[i]);
      if (!std::isfinite(angle.error) || angle.radians - angle.error >= options_.least_radians) continue;
      const std::optional<double> exact = exact_hinge_angle(scene_.x, hinges_[i]);
      if (exact && *exact < options_.least_radians) closed.push_back(i);
    }
    return closed;
  }

  /// Each vertex by the mean of what its hinges ask for.
  void turn(const std::vector<std::size_t>& closed, const Way& way) {
    Positions motion = Positions::Zero(3, scene_.x.cols());
    std::vector<int> asked(static_cast<std::size_t>(scene_.x.cols()), 0);
    std::array<Vec3, 4> gradient;
    for (const std::size_t i : closed) {
      const Hinge& hinge = hinges_[i];
      const std::array<Index, 4> corners = {hinge.a, hinge.b, hinge.c, hinge.d};
      if (!angle_gradient(scene_.x, hinge, gradient)) continue;
      double squared = 0;
      for (int k = 0; k < 4; ++k)
        if (way.moves[k] && !scene_.fixed[corners[k]]) squared += gradient[k].squaredNorm();
      if (!(squared > 0)) continue;
      const double missing = reserve * options_.least_radians - hinge_angle(scene_.x, hinge).radians;
      for (int k = 0; k < 4; ++k) {
        if (!way.moves[k] || scene_.fixed[corners[k]]) continue;
        motion.col(corners[k]) += way.share * missing / squared * gradient[k];
        ++asked[corners[k]];
      }
    }
    for (Index v = 0; v < scene_.x.cols(); ++v) {
      if (asked[v] == 0) continue;
      Vec3 step = motion.col(v) / asked[v];
      const double cap = most_of_height * least_height(v), length = step.norm();
      if (length > cap) step *= cap / length;
      scene_.x.col(v) += step;
    }
  }

  /// The least height of a face at a vertex.
  double least_height(Index v) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Index t : scene_.triangles_of_vertex[v]) {
      const Triangle& corners = scene_.triangles[t];
      double longest = 0;
      for (int k = 0; k < 3; ++k)
        longest = std::max(longest, (scene_.x.col(corners[k]) - scene_.x.col(corners[(k + 1) % 3])).norm());
      const double height = longest > 0 ? area_vector(scene_.x, corners).norm() / longest : 0;
      if (height > 0) least = std::min(least, height);
    }
    return least;
  }

  void keep_near() {
    if (options_.most_motion <= 0) return;
    for (Index v = 0; v < scene_.x.cols(); ++v) {
      const Vec3 way = scene_.x.col(v) - scene_.rest.col(v);
      if (const double length = way.norm(); length > options_.most_motion)
        scene_.x.col(v) = scene_.rest.col(v) + (options_.most_motion / length) * way;
    }
  }

  std::vector<std::array<Index, 2>> near_pairs() const {
    if (!(options_.least_gap > 0)) return {};
    std::vector<std::array<Index, 2>> pairs = pairs_closer_than(scene_.triangles, scene_.x, options_.least_gap);
    std::erase_if(pairs, [&](const auto& pair) { return !scene_.passing().meet(scene_.triangles, pair[0], pair[1]); });
    return pairs;
  }

  /// The faces that intersect or are too near to each other now and were not at the start.
  std::vector<std::array<Index, 2>> new_pairs() const {
    const std::vector<IntersectingPair> pairs = options_.pairs_at(scene_.x);
    std::vector<IntersectingPair> more;
    std::set_difference(pairs.begin(), pairs.end(), tolerated_.begin(), tolerated_.end(), std::back_inserter(more));
    const std::vector<std::array<Index, 2>> near = near_pairs();
    std::vector<std::array<Index, 2>> result;
    std::set_difference(near.begin(), near.end(), tolerated_near_.begin(), tolerated_near_.end(),
                        std::back_inserter(result));
    for (const IntersectingPair& pair : more) result.push_back({pair.a, pair.b});
    return result;
  }

  /// Puts the vertices of such faces back until there are none; where these were not moved, everything.
  void take_back_new_pairs(const Positions& before) {
    for (;;) {
      const std::vector<std::array<Index, 2>> more = new_pairs();
      const bool loses_area = count_lost_areas(before, scene_.x, scene_.triangles) > 0;
      if (more.empty() && !loses_area) return;
      bool any = false;
      for (const std::array<Index, 2>& pair : more)
        for (const Index t : pair)
          for (const Index v : scene_.triangles[t]) {
            any |= scene_.x.col(v) != before.col(v);
            scene_.x.col(v) = before.col(v);
          }
      if (!any || loses_area) {
        scene_.x = before;
        return;
      }
    }
  }

  Scene& scene_;
  const OpenDihedralsOptions& options_;
  const std::vector<Hinge> hinges_;
  std::vector<IntersectingPair> tolerated_;
  std::vector<std::array<Index, 2>> tolerated_near_;
};

}  // namespace

std::size_t open_dihedrals(Scene& scene, const OpenDihedralsOptions& options) {
  if (!(options.least_radians > 0)) return 0;
  return Opening(scene, options).run();
}

}  // namespace unsnarl
