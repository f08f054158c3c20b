#include "untangle/finish_by_contours.h"

#include <algorithm>

#include "scene/trajectory.h"

namespace unsnarl {

std::vector<IntersectingPair> pairs_to_resolve(IntersectionFinder& finder, const Positions& x,
                                               std::span<const IntersectingPair> tolerated) {
  std::vector<IntersectingPair> pairs = blocking_pairs(finder.find(x), tolerated);
  std::erase_if(pairs, [](const IntersectingPair& pair) { return pair.kind == PairClass::duplicate; });
  return pairs;
}

bool finish_by_contours(Patch& patch, Positions& x, IntersectionFinder& finder, const LocalSettings& settings,
                        std::span<const IntersectingPair> tolerated, const Finish& finish,
                        const std::function<bool()>& stop, int& iterations) {
  std::vector<IntersectingPair> ignored(tolerated.begin(), tolerated.end());
  for (const IntersectingPair& pair : blocking_pairs(finder.find(x), tolerated)) {
    if (pair.kind == PairClass::duplicate) ignored.push_back(pair);
  }
  std::sort(ignored.begin(), ignored.end());
  LocalOptions local;
  local.jitter = finish.jitter;
  local.bisections = 0;
  local.area_floor = finish.area_floor;
  const Index n = patch.free_count;
  patch.x.leftCols(n) = x.leftCols(n);
  RecordedTry recorded(patch);
  const LocalResult result = solve_locally(patch, settings, ignored, local, stop);
  iterations += result.iterations;
  if (!result.clean || has_squeezed_face(patch, patch.rest, patch.x, finish.area_floor)) return false;
  recorded.keep();
  x.leftCols(n) = patch.x.leftCols(n);
  return true;
}

}  // namespace unsnarl
