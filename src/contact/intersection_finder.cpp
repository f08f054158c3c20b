#include "contact/intersection_finder.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "geometry/predicates.h"
#include "geometry/triangle_intersection.h"

namespace unsnarl {
namespace {

constexpr std::size_t parallel_threshold = 20000;  // triangles; below it one thread is faster

TrianglePoints rotated(const Positions& x, const Triangle& t, int first) {
  return {x.col(t[first]), x.col(t[(first + 1) % 3]), x.col(t[(first + 2) % 3])};
}

bool is_degenerate(const TrianglePoints& t) { return collinear(t[0], t[1], t[2]); }

}  // namespace

bool intersects(const Positions& x, const Triangle& a, const Triangle& b, PairClass& kind) {
  std::array<int, 3> shared = {-1, -1, -1};  // corner of b that corner k of a is
  int shared_count = 0, corner_a = 0, corner_b = 0, sum_a = 0, sum_b = 0;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l)
      if (a[k] == b[l]) {
        shared[k] = l;
        corner_a = k, corner_b = l;
        sum_a += k, sum_b += l;
        ++shared_count;
        break;
      }
  if (shared_count == 3) {
    kind = PairClass::duplicate;
    return true;
  }
  // A degenerate triangle has every point in its plane; so the cheap rejections below hold for it, and whatever they
  // let pass is looked at again.
  if (shared_count == 0) {
    kind = PairClass::disjoint;
    const TrianglePoints pa = rotated(x, a, 0), pb = rotated(x, b, 0);
    const Sign a0 = orient3d(pb[0], pb[1], pb[2], pa[0]);
    const Sign a1 = orient3d(pb[0], pb[1], pb[2], pa[1]);
    if (a0 * a1 > 0) {
      const Sign a2 = orient3d(pb[0], pb[1], pb[2], pa[2]);
      if (a0 * a2 > 0) return false;
    }
    if (!is_degenerate(pa) && !is_degenerate(pb)) return triangles_meet(pa, pb);
    kind = PairClass::degenerate;
    return degenerate_triangles_meet(pa, pb, shared);
  }
  if (shared_count == 1) {
    kind = PairClass::one_vertex;
    const TrianglePoints pa = rotated(x, a, corner_a), pb = rotated(x, b, corner_b);
    if (orient3d(pb[0], pb[1], pb[2], pa[1]) * orient3d(pb[0], pb[1], pb[2], pa[2]) > 0) return false;
    if (orient3d(pa[0], pa[1], pa[2], pb[1]) * orient3d(pa[0], pa[1], pa[2], pb[2]) > 0) return false;
    if (!is_degenerate(pa) && !is_degenerate(pb)) return triangles_meet_beyond_vertex(pa, pb);
  } else {
    kind = PairClass::folded;
    const int apex_a = 3 - sum_a, apex_b = 3 - sum_b;
    const Vec3 u = x.col(a[(apex_a + 1) % 3]), v = x.col(a[(apex_a + 2) % 3]);
    const TrianglePoints pa = {u, v, x.col(a[apex_a])}, pb = {u, v, x.col(b[apex_b])};
    if (orient3d(pa[0], pa[1], pa[2], pb[2]) != 0) return false;
    if (!is_degenerate(pa) && !is_degenerate(pb)) return triangles_fold_flat(pa, pb);
  }
  kind = PairClass::degenerate;
  return degenerate_triangles_meet(rotated(x, a, 0), rotated(x, b, 0), shared);
}

IntersectionFinder::IntersectionFinder(std::span<const Triangle> triangles)
    : IntersectionFinder(triangles, static_cast<Index>(triangles.size())) {}

IntersectionFinder::IntersectionFinder(std::span<const Triangle> triangles, Index active_count)
    : triangles_(triangles), active_count_(active_count), boxes_(triangles.size()) {}

void IntersectionFinder::update(const Positions& x) {
  auto set_box = [&](std::size_t f) { boxes_[f] = box_of(x, triangles_[f]); };
  if (triangles_.size() < parallel_threshold)
    for (std::size_t f = 0; f < triangles_.size(); ++f) set_box(f);
  else
    oneapi::tbb::parallel_for(std::size_t{0}, triangles_.size(), set_box);
  if (bvh_.size() == static_cast<Index>(triangles_.size()))
    bvh_.refit(boxes_);
  else
    bvh_.build(boxes_);
}

std::vector<IntersectingPair> IntersectionFinder::find(const Positions& x) {
  update(x);
  std::vector<std::vector<IntersectingPair>> found(bvh_.task_count());
  bvh_.self_pairs_parallel([&](Index task, Index i, Index j) {
    if (i >= active_count_ && j >= active_count_) return;
    if (i > j) std::swap(i, j);
    PairClass kind;
    if (intersects(x, triangles_[i], triangles_[j], kind)) found[task].push_back({i, j, kind});
  });
  std::vector<IntersectingPair> pairs;
  for (const auto& list : found) pairs.insert(pairs.end(), list.begin(), list.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool IntersectionFinder::any(const Positions& x) {
  update(x);
  std::atomic<bool> hit{false};
  bvh_.self_pairs_parallel([&](Index, Index i, Index j) {
    if (hit.load(std::memory_order_relaxed) || (i >= active_count_ && j >= active_count_)) return;
    PairClass kind;
    if (intersects(x, triangles_[i], triangles_[j], kind)) hit.store(true, std::memory_order_relaxed);
  });
  return hit.load();
}

}  // namespace unsnarl
