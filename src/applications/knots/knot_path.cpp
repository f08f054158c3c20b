#include "applications/knots/knot_path.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "applications/knots/relax_knot.h"

namespace unsnarl {
namespace {

/// A step that is not proven is halved this many times, at most [E198] (unit: halvings)
constexpr int most_halvings = 6;

/// Appends states after `from` that lead to `to`. False: no proof was found.
bool bridge(const Positions& from, const Positions& to, int halvings, std::vector<Positions>& states) {
  if (is_proven_way(from, to)) {
    states.push_back(to);
    return true;
  }
  if (halvings == 0) return false;
  const Positions middle = 0.5 * (from + to);
  return bridge(from, middle, halvings - 1, states) && bridge(middle, to, halvings - 1, states);
}

}  // namespace

Positions points_of(const std::vector<double>& points) {
  return Eigen::Map<const Positions>(points.data(), 3, static_cast<Index>(points.size() / 3));
}

Positions with_pieces(const Positions& polygon, std::span<const Index> pieces) {
  const auto m = static_cast<Index>(polygon.cols());
  Positions dense(3, std::accumulate(pieces.begin(), pieces.end(), Index{0}));
  Index at = 0;
  for (Index k = 0; k < m; ++k)
    for (Index i = 0; i < pieces[k]; ++i) {
      const double t = static_cast<double>(i) / pieces[k];
      dense.col(at++) = polygon.col(k) + t * (polygon.col((k + 1) % m) - polygon.col(k));
    }
  return dense;
}

double exact_unit(std::span<const Positions> all) {
  double largest = 0;
  for (const Positions& x : all) largest = std::max(largest, x.cwiseAbs().maxCoeff());
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  int exponent = 0;
  const bool is_power = std::frexp(largest, &exponent) == 0.5;
  const double unit = std::ldexp(1, is_power ? exponent - 1 : exponent);  // the least power of two from `largest` on
  if (!std::isfinite(unit)) return 1;
  for (const Positions& x : all)
    if (Positions(x / unit) * unit != x) return 1;
  return unit;
}

DensePolygon densified(const Positions& polygon, Index n) {
  const auto m = static_cast<Index>(polygon.cols());
  DensePolygon made;
  made.pieces.assign(m, 1);
  const auto length = [&](Index k) { return (polygon.col((k + 1) % m) - polygon.col(k)).norm(); };
  const auto shorter = [](const std::pair<double, Index>& a, const std::pair<double, Index>& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, decltype(shorter)> queue(
      shorter);
  for (Index k = 0; k < m; ++k) queue.push({length(k), k});
  for (Index count = m; count < n; ++count) {
    const Index k = queue.top().second;
    queue.pop();
    queue.push({length(k) / ++made.pieces[k], k});
  }
  made.points = with_pieces(polygon, made.pieces);
  return made;
}

std::vector<Positions> thinned_path(std::vector<Positions> states, const std::function<bool()>& stop) {
  std::vector<Positions> kept{states.front()};
  std::size_t at = 0, last_step = 1;
  while (at + 1 < states.size()) {
    if (stop()) return {};
    const std::size_t most = states.size() - 1 - at;
    const auto fits = [&](std::size_t step) { return is_proven_way(states[at], states[at + step]); };
    // The search begins with the last step, since steps change little.
    std::size_t good = 0, bad = most + 1;
    for (std::size_t step = std::min(last_step, most); step > good; step = std::min(2 * good, most)) {
      if (!fits(step)) {
        bad = step;
        break;
      }
      good = step;
    }
    while (bad - good > 1 + good / 8) {  // ends within an eighth of the longest step
      const std::size_t middle = (good + bad) / 2;
      (fits(middle) ? good : bad) = middle;
    }
    if (good == 0) {
      if (!bridge(states[at], states[at + 1], most_halvings, kept)) return {};
      good = 1;
    } else {
      kept.push_back(states[at + good]);
    }
    last_step = good;
    at += good;
  }
  return kept;
}

}  // namespace unsnarl
