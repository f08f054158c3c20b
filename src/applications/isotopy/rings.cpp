#include "applications/isotopy/rings.h"

#include <algorithm>

#include "applications/curves/crossings.h"

namespace unsnarl {

CurveNet net_of(const Polygons& ring) {
  std::vector<Curve> curves;
  for (const Points2& p : ring) {
    Curve& curve = curves.emplace_back();
    curve.closed = true;
    curve.points.assign(p.data(), p.data() + p.size());
  }
  return make_net(curves, {}, false);
}

Points2 joined_points(const Polygons& ring) {
  Eigen::Index count = 0;
  for (const Points2& p : ring) count += p.cols();
  Points2 all(2, count);
  count = 0;
  for (const Points2& p : ring) {
    all.middleCols(count, p.cols()) = p;
    count += p.cols();
  }
  return all;
}

double height_beside(const Polygons& ring) {
  Eigen::AlignedBox2d box;
  for (const Points2& p : ring)
    for (Index k = 0; k < p.cols(); ++k) box.extend(Vec2(p.col(k)));
  return box.diagonal().norm();
}

bool strips_are_embedded(const CurveNet& net, const Polygons& lower, const Polygons& upper, double height) {
  // Between them most that is tangled is seen at once.
  if (!find_meetings(net, 0.5 * (joined_points(lower) + joined_points(upper))).empty()) return false;
  Surface surface;
  std::vector<Index> first;
  for (const auto& [ring, z] : {std::pair(&lower, 0.0), std::pair(&upper, height)})
    for (const Points2& p : *ring) {
      first.push_back(static_cast<Index>(surface.positions.size() / 3));
      for (Index k = 0; k < p.cols(); ++k) surface.positions.insert(surface.positions.end(), {p(0, k), p(1, k), z});
    }
  for (std::size_t c = 0; c < lower.size(); ++c)
    add_strip(straight_rungs(static_cast<Index>(lower[c].cols())), first[c], first[lower.size() + c], surface.corners);
  FindOptions options;
  options.weld = Weld::none;
  return find_intersections(surface, options).empty();
}

std::vector<Rung> straight_rungs(Index n) {
  std::vector<Rung> rungs;
  for (Index k = 0; k < n; ++k) {
    rungs.push_back({k, k});
    rungs.push_back({k, (k + 1) % n});
  }
  return rungs;
}

std::vector<Rung> rungs_to_finer(const std::vector<IsotopyPlace>& places, Index coarse_size) {
  const auto n = static_cast<Index>(places.size());
  // The end of its edge that is nearer to the middle of the piece after point k.
  const auto end_near = [&](Index k) {
    const IsotopyPlace &at = places[k], &next = places[(k + 1) % n];
    const double to = next.edge == at.edge && next.fraction > at.fraction ? next.fraction : 1;
    return at.fraction + to > 1 ? (at.edge + 1) % coarse_size : at.edge;
  };
  std::vector<Rung> rungs;
  for (Index k = 0; k < n; ++k) {
    Index coarse = end_near((k + n - 1) % n);
    rungs.push_back({coarse, k});
    while (coarse != end_near(k)) {
      coarse = (coarse + 1) % coarse_size;
      rungs.push_back({coarse, k});
    }
  }
  return rungs;
}

std::vector<Rung> rungs_to_fewer(const std::vector<Index>& lower, const std::vector<Index>& upper) {
  std::vector<Rung> rungs;
  const auto n = static_cast<Index>(upper.size());
  Index next = 0;  // of the upper polygon
  for (std::size_t k = 0; k < lower.size(); ++k) {
    const auto at = static_cast<Index>(k);
    if (next < n && upper[next] == lower[k]) {
      rungs.push_back({at, next++});
    } else {
      rungs.push_back({at, (next + n - 1) % n});
      rungs.push_back({at, next % n});
    }
  }
  return rungs;
}

std::vector<Rung> upside_down(std::vector<Rung> rungs) {
  for (Rung& rung : rungs) std::swap(rung.lower, rung.upper);
  return rungs;
}

void Stack::add(Polygons ring, std::vector<std::vector<Rung>> from_last) {
  if (!rings.empty()) rungs.push_back(std::move(from_last));
  rings.push_back(std::move(ring));
}

void Stack::add_above(Stack other) {
  for (std::size_t k = 1; k < other.rings.size(); ++k) add(std::move(other.rings[k]), std::move(other.rungs[k - 1]));
}

Stack Stack::first(std::size_t size) const {
  return {{rings.begin(), rings.begin() + static_cast<std::ptrdiff_t>(size)},
          {rungs.begin(), rungs.begin() + static_cast<std::ptrdiff_t>(size - 1)}};
}

Stack Stack::upside_down() const {
  Stack made{{rings.rbegin(), rings.rend()}, {rungs.rbegin(), rungs.rend()}};
  for (auto& strip : made.rungs)
    for (auto& polygon : strip) polygon = unsnarl::upside_down(std::move(polygon));
  return made;
}

void add_strip(const std::vector<Rung>& rungs, Index lower, Index upper, std::vector<std::int32_t>& corners) {
  for (std::size_t k = 0; k < rungs.size(); ++k) {
    const Rung &at = rungs[k], &next = rungs[(k + 1) % rungs.size()];
    if (at.lower != next.lower) corners.insert(corners.end(), {lower + at.lower, lower + next.lower, upper + at.upper});
    if (at.upper != next.upper)
      corners.insert(corners.end(), {lower + next.lower, upper + next.upper, upper + at.upper});
  }
}

std::vector<std::size_t> thin_out(const std::vector<Polygons>& rings, double height) {
  const CurveNet net = net_of(rings.front());
  std::vector<std::size_t> kept{0};
  std::size_t last_step = 2;
  while (kept.back() + 1 < rings.size()) {
    const std::size_t at = kept.back(), most = rings.size() - 1 - at;
    const auto fits = [&](std::size_t step) { return strips_are_embedded(net, rings[at], rings[at + step], height); };
    // The search begins with the last step, since steps change little.
    std::size_t good = 1, bad = most + 1;
    for (std::size_t step = std::min(last_step, most); good < most && step > good; step = std::min(2 * good, most)) {
      if (fits(step)) {
        good = step;
      } else {
        bad = step;
        break;
      }
    }
    while (bad - good > 1 + good / 8) {  // ends within an eighth of the longest step
      const std::size_t middle = (good + bad) / 2;
      (fits(middle) ? good : bad) = middle;
    }
    last_step = std::max<std::size_t>(2, good);
    kept.push_back(at + good);
  }
  return kept;
}

}  // namespace unsnarl
