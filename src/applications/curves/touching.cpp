#include "applications/curves/touching.h"

#include <algorithm>
#include <cmath>

#include "geometry/splitmix.h"

namespace unsnarl {

Vec2 jitter_of(std::uint64_t vertex, std::uint64_t round) {
  const auto noise = [&](std::uint64_t axis) {
    return 2 * splitmix_number((vertex * 2 + axis) * splitmix_step + round * 0xD1B54A32D192ED03ULL) - 1;
  };
  const double along = noise(0), up = noise(1);
  return {along, up};
}

void draw_in_what_lies_on_others(const CurveNet& net, SegmentTree& tree, Points2& x, const TouchingOptions& options) {
  std::vector<std::uint8_t> moves(net.vertex_count(), 0);
  for (const SegmentPair& pair : find_meetings(net, tree, x))
    if (pair.kind == SegmentMeeting::touching && net.chain_of[pair.i] != net.chain_of[pair.j])
      for (const Index v : net.segments[std::max(pair.i, pair.j)]) moves[v] = !net.pinned[v];
  const Points2 old = x;
  for (const CurveNet::Chain& chain : net.chains) {
    double area = 0;
    for (Index k = 0; k < chain.size(); ++k) {
      const Vec2 a = old.col(chain.at(k)), b = old.col(chain.at(k + 1));
      area += a.x() * b.y() - b.x() * a.y();
    }
    const double inwards = chain.closed && area < 0 ? -1 : 1;
    for (Index k = 0; k < chain.size(); ++k) {
      const Index v = chain.vertices[k];
      if (!moves[v]) continue;
      const bool first = !chain.closed && k == 0, last = !chain.closed && k + 1 == chain.size();
      const Vec2 p = old.col(v);
      const Vec2 before = first ? Vec2(0, 0) : Vec2(p - old.col(chain.at((k + chain.size() - 1) % chain.size())));
      const Vec2 after = last ? Vec2(0, 0) : Vec2(old.col(chain.at(k + 1)) - p);
      const Vec2 along = before.stableNormalized() + after.stableNormalized();
      if (along.squaredNorm() == 0) continue;
      double length = std::max(before.norm(), after.norm());
      if (!first && !last) length = std::min(before.norm(), after.norm());
      const Vec2 normal = Vec2(-along.y(), along.x()).normalized();
      x.col(v) += inwards * std::min(options.inset_rel * net.diagonal, options.inset_part * length) * normal;
    }
  }
  tree.refit(x);
}

std::vector<SegmentPair> move_apart_what_touches(const CurveNet& net, SegmentTree& tree, Points2& x,
                                                 std::uint64_t& round, const TouchingOptions& options) {
  std::vector<SegmentPair> pairs = find_meetings(net, tree, x);
  double part = options.jitter;
  for (int k = 0; k < options.tries; ++k, part *= 10) {
    std::vector<std::uint8_t> moves(net.vertex_count(), 0);
    bool any = false;
    for (const SegmentPair& pair : pairs)
      if (pair.kind == SegmentMeeting::touching)
        for (const Index s : {pair.i, pair.j})
          for (const Index v : net.segments[s])
            if (!net.pinned[v]) {
              moves[v] = 1;
              any = true;
            }
    if (!any) break;
    for (Index v = 0; v < net.vertex_count(); ++v) {
      if (!moves[v]) continue;
      const double length = std::max(net.weight[v], options.least_jitter_rel * net.diagonal);
      x.col(v) += part * length * jitter_of(static_cast<std::uint64_t>(v), round);
    }
    ++round;
    tree.refit(x);
    pairs = find_meetings(net, tree, x);
  }
  return pairs;
}

}  // namespace unsnarl
