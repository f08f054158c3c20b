#include "applications/knots/align_knots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include "geometry/rotation.h"

namespace unsnarl {

Positions Alignment::applied(const Positions& x) const {
  return ((scale * rotation) * (x.colwise() - from)).colwise() + to;
}

Positions reordered(const Positions& x, Index first, bool backwards) {
  const auto n = static_cast<Index>(x.cols());
  Positions y(3, n);
  for (Index k = 0; k < n; ++k) y.col(k) = x.col((first + (backwards ? n - k : k)) % n);
  return y;
}

Index nearest_order(const Positions& x, const Positions& y) {
  const auto n = static_cast<Index>(x.cols());
  Index best = 0;
  double largest = -std::numeric_limits<double>::infinity();
  for (Index first = 0; first < n; ++first) {
    const double product = x.cwiseProduct(reordered(y, first, false)).sum();
    if (product > largest) {
      largest = product;
      best = first;
    }
  }
  return best;
}

std::vector<Alignment> alignments(const Positions& x, const Positions& y, bool backwards, std::size_t most) {
  const auto n = static_cast<Index>(x.cols());
  const Vec3 x_centre = x.rowwise().mean(), y_centre = y.rowwise().mean();
  const Positions a = x.colwise() - x_centre;
  std::vector<Alignment> all(n);
  for (Index first = 0; first < n; ++first) {
    Alignment& made = all[first];
    const Positions b = reordered(y, first, backwards).colwise() - y_centre;
    made.rotation = nearest_rotation(a.lazyProduct(b.transpose()));
    made.scale = a.norm() / b.norm();
    made.from = y_centre;
    made.to = x_centre;
    made.first = first;
    made.backwards = backwards;
    made.distance = (a - made.scale * made.rotation * b).norm() / a.norm();
  }
  std::vector<Alignment> best;
  for (Index k = 0; k < n; ++k)
    if (all[k].distance <= all[(k + 1) % n].distance && all[k].distance < all[(k + n - 1) % n].distance)
      best.push_back(all[k]);
  std::stable_sort(best.begin(), best.end(),
                   [](const Alignment& p, const Alignment& q) { return p.distance < q.distance; });
  if (best.empty()) best.push_back(all[0]);  // of two regular polygons all are alike
  if (best.size() > most) best.resize(most);
  return best;
}

}  // namespace unsnarl
