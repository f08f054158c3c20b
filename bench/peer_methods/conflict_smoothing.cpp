// Laplacian smoothing around what intersects, the baseline of mesh editors: every vertex near an intersecting face goes
// half the way to the mean of its neighbours (uniform weights; Taubin: "A Signal Processing Approach to Fair Surface
// Design", 1995, §3, without the step that undoes the shrinking), until nothing intersects. No paper stands behind its
// use for repair, so the constants are ours; where it does not get on, it takes in one ring more.
#include <limits>

#include "mesh/adjacency.h"
#include "peer.h"

namespace unsnarl::peers {
namespace {

struct ConflictSmoothingOptions {
  double share = 0.5;  // of the way to the mean of the neighbours, an iteration
  int rings = 2;       // of vertices around the intersecting faces, at first
  int patience = 20;   // iterations without a new least number of pairs before a ring is added
  int most_iterations = 1000;
};

class ConflictSmoothing : public Peer {
 public:
  ConflictSmoothing(const Start& start, const ConflictSmoothingOptions& options)
      : options_(options), triangles_(start.triangles), rings_(options.rings) {
    const EdgeTable edges = build_edges(start.triangles);
    neighbours_ = vertex_neighbours(edges.edges, static_cast<Index>(start.rest.cols()));
  }

  int most_iterations() const override { return options_.most_iterations; }

  bool step(const std::vector<IntersectingPair>& pairs, Positions& x) override {
    if (pairs.size() < least_pairs_) {
      least_pairs_ = pairs.size();
      waited_ = 0;
    } else if (++waited_ >= options_.patience) {
      ++rings_;
      waited_ = 0;
    }
    const Positions before = x;
    for (Index v : vertices_around(pairs)) {
      if (neighbours_[v].empty()) continue;
      Vec3 mean = Vec3::Zero();
      for (Index w : neighbours_[v]) mean += before.col(w);
      mean /= static_cast<double>(neighbours_[v].size());
      x.col(v) += options_.share * (mean - before.col(v));
    }
    return true;
  }

 private:
  std::vector<Index> vertices_around(const std::vector<IntersectingPair>& pairs) const {
    std::vector<std::uint8_t> is_in(neighbours_.size(), 0);
    std::vector<Index> vertices;
    const auto add = [&](Index v) {
      if (!is_in[v]) vertices.push_back(v);
      is_in[v] = 1;
    };
    for (const IntersectingPair& pair : pairs)
      for (Index t : {pair.a, pair.b})
        for (Index v : triangles_[t]) add(v);
    std::size_t begin = 0;
    for (int ring = 0; ring < rings_; ++ring) {
      const std::size_t end = vertices.size();
      for (; begin < end; ++begin)
        for (Index w : neighbours_[vertices[begin]]) add(w);
    }
    return vertices;
  }

  ConflictSmoothingOptions options_;
  std::span<const Triangle> triangles_;
  IndexLists neighbours_;
  int rings_ = 0, waited_ = 0;
  std::size_t least_pairs_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace

std::unique_ptr<Peer> make_conflict_smoothing(const Start& start) {
  return std::make_unique<ConflictSmoothing>(start, ConflictSmoothingOptions{});
}

}  // namespace unsnarl::peers
