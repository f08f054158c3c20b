#include "applications/knots/strip.h"

#include <algorithm>
#include <cmath>

#include "contact/bvh.h"

namespace unsnarl {
namespace {

/// The corners of a triangle as numbers: those of the lower polygon, then those of the upper one.
std::array<Index, 3> ids_of(const StripTriangle& t, Index lower_size, Index upper_size) {
  if (t.on_lower) return {t.edge, (t.edge + 1) % lower_size, lower_size + t.apex};
  return {lower_size + t.edge, lower_size + (t.edge + 1) % upper_size, t.apex};
}

std::vector<StripTriangle> strip_of(std::span<const Index> pieces, bool finer_is_upper, Index first) {
  std::vector<StripTriangle> strip;
  const auto coarse_size = static_cast<Index>(pieces.size());
  Index fine_size = 0;
  for (const Index count : pieces) fine_size += count;
  Index fine = first;
  for (Index k = 0; k < coarse_size; ++k) {
    if (!finer_is_upper) strip.push_back({false, k, fine});
    for (Index i = 0; i < pieces[k]; ++i) {
      strip.push_back({!finer_is_upper, fine, finer_is_upper ? k : (k + 1) % coarse_size});
      fine = (fine + 1) % fine_size;
    }
    if (finer_is_upper) strip.push_back({true, k, fine});
  }
  return strip;
}

}  // namespace

std::vector<StripTriangle> straight_strip(Index n) {
  return strip_of(std::vector<Index>(n, 1), true, 0);
}

std::vector<StripTriangle> strip_to_finer(std::span<const Index> pieces) {
  return strip_of(pieces, true, 0);
}

std::vector<StripTriangle> strip_from_finer(std::span<const Index> pieces, Index first) {
  return strip_of(pieces, false, first);
}

Triangle4 corners_of(const StripTriangle& t, const Positions& lower, const Positions& upper, double height) {
  const auto at = [](const Positions& x, Index k, double h) { return Vec4(x(0, k), x(1, k), x(2, k), h); };
  const Positions& edge = t.on_lower ? lower : upper;
  const double edge_height = t.on_lower ? 0 : height;
  const auto n = static_cast<Index>(edge.cols());
  return {at(edge, t.edge, edge_height), at(edge, (t.edge + 1) % n, edge_height),
          at(t.on_lower ? upper : lower, t.apex, height - edge_height)};
}

std::vector<StripPair> meeting_pairs(const Positions& lower, const Positions& upper,
                                     std::span<const StripTriangle> strip, std::size_t most) {
  const auto m = static_cast<Index>(lower.cols()), n = static_cast<Index>(upper.cols());
  // The height is arbitrary; with about the length of the edges, separating hyperplanes are easiest to find.
  double length = 0;
  for (Index k = 0; k < m; ++k) length = std::max(length, (lower.col((k + 1) % m) - lower.col(k)).norm());
  const double height = length > 0 ? std::ldexp(1, std::ilogb(length)) : 1;
  std::vector<Triangle4> corners;
  std::vector<std::array<Index, 3>> ids;
  std::vector<Box> boxes;
  std::vector<StripPair> pairs;
  for (std::size_t k = 0; k < strip.size(); ++k) {
    corners.push_back(corners_of(strip[k], lower, upper, height));
    ids.push_back(ids_of(strip[k], m, n));
    Box& box = boxes.emplace_back();
    for (const Vec4& p : corners.back()) box.extend(Vec3(p.head<3>()));
    if (corners.back()[0] == corners.back()[1]) pairs.push_back({static_cast<Index>(k), static_cast<Index>(k)});
  }
  if (!pairs.empty()) return pairs;
  const auto visit = [&](Index i, Index j) {
    if (pairs.size() >= most) return;
    Triangle4 a = corners[i], b = corners[j];
    std::array<Index, 3> ids_a = ids[i], ids_b = ids[j];
    int shared = 0;
    for (int k = 0; k < 3; ++k)
      for (int l = shared; l < 3; ++l)
        if (ids_a[k] == ids_b[l]) {
          std::swap(ids_a[k], ids_a[shared]), std::swap(a[k], a[shared]);
          std::swap(ids_b[l], ids_b[shared]), std::swap(b[l], b[shared]);
          ++shared;
          break;
        }
    if (shared == 3 || triangles_meet(a, b, shared)) pairs.push_back({std::min(i, j), std::max(i, j)});
  };
  Bvh(boxes).self_pairs(visit);
  std::sort(pairs.begin(), pairs.end(),
            [](const StripPair& p, const StripPair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
  return pairs;
}

bool is_isotopy(const Positions& lower, const Positions& upper) {
  return meeting_pairs(lower, upper, straight_strip(static_cast<Index>(lower.cols())), 1).empty();
}

}  // namespace unsnarl
