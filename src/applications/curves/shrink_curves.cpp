#include "applications/curves/shrink_curves.h"

namespace unsnarl {
namespace {

/// The shortest curve that meets another one, not itself, and is not `hopeless`; -1: none.
Index shortest_that_meets_others(const CurveNet& net, const std::vector<SegmentPair>& pairs,
                                 const std::vector<std::uint8_t>& hopeless) {
  const auto length = [&](Index c) {
    double sum = 0;
    for (const Index v : net.chains[c].vertices) sum += net.weight[v];
    return sum;
  };
  std::vector<std::uint8_t> meets_itself(net.chains.size(), 0);
  for (const SegmentPair& pair : pairs)
    if (net.chain_of[pair.i] == net.chain_of[pair.j]) meets_itself[net.chain_of[pair.i]] = 1;
  Index chosen = -1;
  for (const SegmentPair& pair : pairs)
    for (const Index c : {net.chain_of[pair.i], net.chain_of[pair.j]})
      if (net.chain_of[pair.i] != net.chain_of[pair.j] && !hopeless[c] && !meets_itself[c] &&
          (chosen < 0 || length(c) < length(chosen) || (length(c) == length(chosen) && c < chosen)))
        chosen = c;
  return chosen;
}

/// Does no segment of the chain meet another one?
bool is_free(const CurveNet& net, const CurveNet::Chain& chain, const SegmentTree& tree, const Points2& x) {
  bool result = true;
  for (Index s = chain.first_segment; result && s < chain.first_segment + chain.segment_count(); ++s) {
    const Vec2 a = x.col(net.segments[s][0]), b = x.col(net.segments[s][1]);
    tree.near(a.cwiseMin(b), a.cwiseMax(b), [&](Index j) {
      if (j != s && result) result = meeting_of(x, net.segments[s], net.segments[j]) == SegmentMeeting::none;
    });
  }
  return result;
}

}  // namespace

std::vector<SegmentPair> shrink_curves(const CurveNet& net, CurveState& state, const ShrinkOptions& options) {
  SegmentTree tree(net);
  tree.refit(state.x);
  std::vector<SegmentPair> pairs = find_meetings(net, tree, state.x);
  std::vector<std::uint8_t> hopeless(net.chains.size(), 0);
  while (!pairs.empty()) {
    const Index chosen = shortest_that_meets_others(net, pairs, hopeless);
    if (chosen < 0) return pairs;
    const CurveNet::Chain& chain = net.chains[chosen];
    std::vector<Index> centres;
    for (const Index v : chain.vertices)
      if (net.pinned[v]) centres.push_back(v);
    if (centres.empty())
      for (int k = 0; k < options.places; ++k)
        centres.push_back(chain.vertices[static_cast<std::size_t>(k) * chain.vertices.size() / options.places]);
    hopeless[chosen] = 1;
    if (centres.size() > 1 && net.pinned[centres[0]]) continue;
    const Points2 old = state.x;
    Points2 best = old;
    double largest = 0;
    for (const Index centre : centres) {
      const Vec2 c = old.col(centre);
      double scale = 0.5;
      for (int k = 0; k < options.halvings && scale > largest; ++k, scale *= 0.5) {
        for (const Index v : chain.vertices) state.x.col(v) = c + scale * (old.col(v) - c);
        tree.refit(state.x);
        if (!is_free(net, chain, tree, state.x)) continue;
        largest = scale;
        best = state.x;
        break;
      }
    }
    state.x = best;
    tree.refit(state.x);
    pairs = find_meetings(net, tree, state.x);
  }
  return pairs;
}

}  // namespace unsnarl
