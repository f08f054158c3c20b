#include "applications/knots/untangle_cylinder.h"

#include <array>

#include "applications/knots/cylinder_energy.h"
#include "optimize/lbfgs.h"

namespace unsnarl {
namespace {

constexpr int ring_count = 13;  ///< Rings of the cylinder, both ends among them (unit: rings)
/// Ranges of the Gaussian, one after the other (unit: mean edges)
constexpr std::array<double, 3> ranges = {8, 4, 2};
constexpr int iterations = 40;  ///< Iterations with each range, at most (unit: iterations)
/// Double points are counted after this many iterations (unit: iterations)
constexpr int look_every = 10;

}  // namespace

std::vector<KnotDoublePoint> double_points(const std::vector<Positions>& rings) {
  std::vector<KnotDoublePoint> points;
  const double strips = static_cast<double>(rings.size() - 1);
  const std::vector<StripTriangle> strip = straight_strip(static_cast<Index>(rings.front().cols()));
  for (std::size_t k = 0; k + 1 < rings.size(); ++k)
    for (const StripPair& pair : meeting_pairs(rings[k], rings[k + 1], strip, SIZE_MAX)) {
      const StripTriangle &s = strip[pair.a], &t = strip[pair.b];
      const Triangle4 a = corners_of(s, rings[k], rings[k + 1], 1), b = corners_of(t, rings[k], rings[k + 1], 1);
      // Corners run around the cylinder the one way where the edge is below, else the other.
      const int sign = crossing_sign(a, b) * (s.on_lower == t.on_lower ? 1 : -1);
      const Vec4 p = sign != 0 ? crossing_point(a, b) : Vec4((a[0] + b[0]) / 2);
      points.push_back({(static_cast<double>(k) + p[3]) / strips, {p[0], p[1], p[2]}, sign});
    }
  return points;
}

UntangledCylinder untangle_cylinder(const Positions& from, const Positions& to,
                                    const std::function<bool(double fraction)>& stop) {
  UntangledCylinder made;
  made.rings = {from, to};
  made.left = double_points(made.rings);
  if (made.left.empty() || stop(0)) return made;
  std::vector<Positions> rings;
  for (int r = 0; r < ring_count; ++r) {
    const double t = static_cast<double>(r) / (ring_count - 1);
    rings.push_back((1 - t) * from + t * to);
  }
  CylinderEnergy energy(std::move(rings));
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(energy.size());
  double stage = 0;
  for (const double epsilon : ranges) {
    energy.epsilon = epsilon;
    LbfgsOptions options;
    options.max_iterations = iterations;
    bool done = false;
    minimize_lbfgs(
        [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) { return energy(x, gradient); }, displacement, options,
        [&](const Eigen::VectorXd& v, Eigen::VectorXd& out) { energy.precondition(v, out); },
        [&](LbfgsIteration& at) {
          if (at.iteration % look_every == 0) {
            std::vector<Positions> now = energy.rings_at(at.x);
            std::vector<KnotDoublePoint> left = double_points(now);
            if (left.size() <= made.left.size()) {
              made.left = std::move(left);
              made.rings = std::move(now);
            }
          }
          done = made.left.empty() ||
                 stop((stage + static_cast<double>(at.iteration) / iterations) / static_cast<double>(ranges.size()));
          return done;
        });
    if (done) break;
    stage += 1;
  }
  return made;
}

}  // namespace unsnarl
