#include "applications/isotopy/annulus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "applications/curves/crossings.h"
#include "applications/isotopy/annulus_energy.h"
#include "geometry/portable_math.h"
#include "optimize/lbfgs.h"

namespace unsnarl {
namespace {

/// Strips of an annulus before it is untangled (unit: strips)
constexpr int strip_count = 24;
/// Ranges of the Gaussian, one after the other [E276] (unit: mean edges)
constexpr std::array<double, 3> annulus_ranges = {8, 4, 2};
constexpr int annulus_iterations = 30;  ///< Iterations with each range, at most (unit: iterations)
/// Intersections are counted after this many iterations (unit: iterations)
constexpr int annulus_look_every = 5;
/// Untangling ends after this many iterations if more than the share below of the tangles is left (unit: iterations)
constexpr int annulus_trial = 10;
static_assert(annulus_trial % annulus_look_every == 0, "tangles are counted when the trial ends");
/// Share of the tangles at the start that may be left after the trial [E275] (no unit)
constexpr double annulus_trial_left = 0.8;

double perimeter(const Points2& p) {
  double length = 0;
  for (Index k = 0; k < p.cols(); ++k) length += (p.col((k + 1) % p.cols()) - p.col(k)).norm();
  return length;
}

double area_of(const Points2& p) {
  double area = 0;
  for (Index k = 1; k + 1 < p.cols(); ++k) {
    const Vec2 a = p.col(k) - p.col(0), b = p.col(k + 1) - p.col(0);
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

/// Crossings of the rings, until there are more than `most`. The middle ring comes first, since most is amiss there.
std::size_t crossings_of(const CurveNet& net, const std::vector<Polygons>& rings, std::size_t most) {
  std::size_t sum = 0;
  const std::size_t middle = rings.size() / 2;
  for (std::size_t k = 0; k < rings.size() && sum <= most; ++k)
    sum += find_meetings(net, joined_points(rings[k % 2 == 0 ? middle + k / 2 : middle - (k + 1) / 2])).size();
  return sum;
}

/// Edges of a polygon: their lengths, and directions as angles that go on around it without jumps.
struct Edges {
  std::vector<double> length, angle;
  double mean_angle = 0;

  explicit Edges(const Points2& p) {
    const auto n = static_cast<Index>(p.cols());
    double whole = 0;
    for (Index k = 0; k < n; ++k) {
      const Vec2 edge = p.col((k + 1) % n) - p.col(k);
      double now = portable::atan2(edge.y(), edge.x());
      if (k > 0) now += 2 * std::numbers::pi * std::floor((angle.back() - now) / (2 * std::numbers::pi) + 0.5);
      length.push_back(edge.norm());
      angle.push_back(now);
      whole += length.back();
    }
    for (Index k = 0; k < n; ++k) mean_angle += angle[k] * length[k] / whole;
  }
};

/// The polygon at a height: edges between those of both; what is missing to close it is shared by length.
Points2 bent(const Edges& from, const Edges& to, const Vec2& middle, double turned, double height) {
  const auto n = static_cast<Index>(from.length.size());
  Points2 p(2, n);
  std::vector<double> arc(n + 1, 0);
  Vec2 at(0, 0);
  for (Index k = 0; k < n; ++k) {
    p.col(k) = at;
    const double length = (1 - height) * from.length[k] + height * to.length[k];
    const double angle = (1 - height) * from.angle[k] + height * (to.angle[k] + turned);
    at += length * Vec2(portable::cos(angle), portable::sin(angle));
    arc[k + 1] = arc[k] + length;
  }
  for (Index k = 0; k < n; ++k) p.col(k) -= arc[k] / arc[n] * at;
  const Vec2 shift = middle - Vec2(p.rowwise().mean());
  return p.colwise() + shift;
}

}  // namespace

Annuli naive_annuli(const Polygons& start, const Polygons& end, Blend blend, std::size_t most) {
  Annuli made;
  std::vector<Edges> from, to;
  if (blend == Blend::bending)
    for (std::size_t c = 0; c < start.size(); ++c) {
      from.emplace_back(start[c]);
      to.emplace_back(end[c]);
    }
  for (int r = 0; r <= strip_count; ++r) {
    const double t = static_cast<double>(r) / strip_count;
    made.heights.push_back(t);
    if (r == 0 || r == strip_count) {
      made.rings.push_back(r == 0 ? start : end);
      continue;
    }
    Polygons& ring = made.rings.emplace_back();
    for (std::size_t c = 0; c < start.size(); ++c) {
      if (blend == Blend::straight) {
        ring.push_back((1 - t) * start[c] + t * end[c]);
        continue;
      }
      const double turns = std::floor((from[c].mean_angle - to[c].mean_angle) / (2 * std::numbers::pi) + 0.5);
      const Vec2 middle = (1 - t) * start[c].rowwise().mean() + t * end[c].rowwise().mean();
      ring.push_back(bent(from[c], to[c], middle, 2 * std::numbers::pi * turns, t));
    }
  }
  made.tangles = crossings_of(net_of(start), made.rings, most);
  return made;
}

std::size_t tangled_strips(const Annuli& annuli, std::size_t most) {
  const CurveNet net = net_of(annuli.rings.front());
  const double height = height_beside(annuli.rings.front());
  std::size_t sum = 0;
  for (std::size_t k = 0; k + 1 < annuli.rings.size() && sum <= most; ++k)
    sum += strips_are_embedded(net, annuli.rings[k], annuli.rings[k + 1], height) ? 0 : 1;
  return sum;
}

Annuli untangled(const Annuli& annuli, const std::function<bool()>& stop) {
  Annuli best = annuli;
  const CurveNet net = net_of(annuli.rings.front());
  AnnulusEnergy energy(annuli.rings);
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(energy.size());
  for (const double range : annulus_ranges) {
    energy.range = range;
    LbfgsOptions options;
    options.max_iterations = annulus_iterations;
    options.block = 2;
    bool done = false;
    const std::size_t before = best.tangles;
    minimize_lbfgs([&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) { return energy(x, gradient); },
                   displacement, options,
                   [&](const Eigen::VectorXd& v, Eigen::VectorXd& out) { energy.precondition(v, out); },
                   [&](LbfgsIteration& at) {
                     if (at.iteration % annulus_look_every == 0) {
                       Annuli now{energy.rings_at(at.x), annuli.heights, 0};
                       now.tangles = crossings_of(net, now.rings, best.tangles);
                       if (now.tangles == 0) now.tangles = tangled_strips(now, best.tangles);
                       if (now.tangles < best.tangles) best = std::move(now);
                     }
                     const bool is_vain =
                         range == annulus_ranges.front() && at.iteration == annulus_trial &&
                         static_cast<double>(best.tangles) > annulus_trial_left * static_cast<double>(annuli.tangles);
                     done = best.tangles == 0 || is_vain || stop();
                     return done;
                   });
    if (done || best.tangles == before) break;
  }
  return best;
}

double length_of(const Polygons& ring) {
  double length = 0;
  for (const Points2& p : ring) length += perimeter(p);
  return length;
}

ShapeKept shape_kept(const std::vector<Polygons>& rings, const std::vector<double>& heights) {
  ShapeKept kept;
  for (std::size_t c = 0; c < rings.front().size(); ++c) {
    const double from_length = perimeter(rings.front()[c]), to_length = perimeter(rings.back()[c]);
    const double from_area = area_of(rings.front()[c]), to_area = area_of(rings.back()[c]);
    for (std::size_t r = 1; r + 1 < rings.size(); ++r) {
      const double t = heights[r];
      kept.length = std::min(kept.length, perimeter(rings[r][c]) / ((1 - t) * from_length + t * to_length));
      kept.area = std::min(kept.area, area_of(rings[r][c]) / ((1 - t) * from_area + t * to_area));
    }
  }
  return kept;
}

}  // namespace unsnarl
