#include "untangle/recede.h"

#include <algorithm>
#include <cmath>

#include "geometry/box.h"
#include "scene/trajectory.h"
#include "untangle/finish_by_contours.h"
#include "untangle/recession.h"

namespace unsnarl {

RecedeResult recede(Patch& patch, const std::function<bool()>& stop, std::span<const IntersectingPair> tolerated,
                    const RecedeOptions& options) {
  RecedeResult result;
  const Index n = patch.free_count;
  const double h = patch.edge_length;
  patch.x.leftCols(n) = patch.rest.leftCols(n);
  IntersectionFinder finder(patch.triangles, patch.active_count);
  result.clean = pairs_to_resolve(finder, patch.x, tolerated).empty();
  if (result.clean || n == 0 || !(h > 0)) return result;
  const std::span<const Triangle> active(patch.triangles.data(), static_cast<std::size_t>(patch.active_count));
  const Recession recession(active, patch.rest, n);
  if (!recession.possible()) return result;
  Box box;
  for (const Triangle& t : active) box.extend(box_of(patch.rest, t));
  const double diagonal = box.diagonal() / h;
  Positions x = patch.x, best = patch.x;
  const int shares = static_cast<int>(std::ceil((1 - options.first_share) / options.share_step - 1e-9));
  // Recovery does not get far from faces squeezed to slivers: they are the answer only where nothing better comes.
  for (const auto& [step_rel, locality_rel] : options.strides) {
    const LocalSettings contour{LocalMethod::contour, std::max(0.3, step_rel * diagonal),
                                std::max(4.0, locality_rel * diagonal), options.iterations};
    for (int k = 0; k < shares; ++k) {
      if (stop && stop()) break;
      RecordedTry recorded(patch);
      recession.positions(options.first_share + k * options.share_step, x);
      const Finish finish{options.jitter, options.last_floor};
      if (!finish_by_contours(patch, x, finder, contour, tolerated, finish, stop, result.iterations)) continue;
      if (!result.clean) best = x;
      result.clean = true;
      if (has_squeezed_face(patch, patch.rest, x, options.floor)) continue;
      patch.x = x;
      recorded.keep();
      return result;
    }
  }
  patch.x = best;
  return result;
}

}  // namespace unsnarl
