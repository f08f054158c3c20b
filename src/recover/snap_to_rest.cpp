#include "recover/snap_to_rest.h"

#include <algorithm>

namespace unsnarl {

Index snap_to_rest(Positions& x, const Positions& rest, double reach, ContactRules& rules,
                   const OrientedFaces& oriented, EmbeddingGuard& guard, std::span<const std::uint8_t> moves,
                   int rounds) {
  BlockList<ContactRule> close;
  std::vector<SeparatedStencil> filter;
  std::vector<std::uint8_t> trying(moves.size());
  MotionBounds bounds;
  bounds.reset(static_cast<Index>(x.cols()));
  Positions p(3, x.cols());
  Positions safe;
  Index arrived = 0;
  for (int round = 0; round < rounds; ++round) {
    p.setZero();
    bool any = false;
    for (Index v = 0; v < x.cols(); ++v) {
      trying[v] = 0;
      if (!moves[v] || x.col(v) == rest.col(v)) continue;
      const Vec3 way = rest.col(v) - x.col(v);
      if (way.norm() > reach) continue;
      p.col(v) = way;
      trying[v] = 1;
      any = true;
    }
    if (!any) return arrived;
    bounds.along = p;
    rules.gather(x, rules.options().min_gap, bounds, trying, close);
    filter.clear();
    for (const ContactRule& rule : close) filter.push_back({rule.stencil.stencil, rule.stencil.separation});
    filter_step(filter, oriented, x, p, OnCollision::stay, {.stop = rules.options().stop});
    safe = x;
    Index moved = 0;
    for (Index v = 0; v < x.cols(); ++v) {
      if (!trying[v] || p.col(v).isZero(0)) continue;
      x.col(v) = rest.col(v);
      ++moved;
    }
    if (moved == 0) break;
    moved -= guard.roll_back(x, safe);
    arrived += std::max(moved, Index{0});
    if (moved <= 0) break;
  }
  return arrived;
}

}  // namespace unsnarl
