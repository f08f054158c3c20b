#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "contact/intersection_finder.h"
#include "scene/output_format.h"

namespace unsnarl {

/// One finder for the positions as they are, and one for those rounded to float32: a single finder that alternates
/// between the two would decide all pairs again at every call.
class Finders {
 public:
  /// `scale`: of the positions. The triangles must outlive this.
  Finders(std::span<const Triangle> triangles, const Scale& scale, Passing passing = {})
      : as_is(triangles, passing), scale_(scale) {}

  /// They find pairs of these triangles. Takes as long as a look at all of them.
  bool are_of(std::span<const Triangle> triangles) const {
    return std::equal(triangles.begin(), triangles.end(), as_is.triangles().begin(), as_is.triangles().end());
  }

  /// States that nothing intersects at x, nor once x is rounded to float32 if `rounded_too`.
  void start_without_pairs(const Positions& x, bool rounded_too) {
    as_is.start_from(x, {});
    if (!rounded_too) return;
    rounded_ = as_is;
    rounded_->start_from(rounded_to_float32(x, scale_), {});
  }

  IntersectionFinder as_is;
  /// The pairs at these positions once they are rounded to float32.
  std::vector<IntersectingPair> find_rounded(const Positions& x) {
    // A copy of the first finder: the tree need not be built again, nor pairs decided that float32 does not move.
    if (!rounded_) rounded_ = as_is;
    return rounded_->find(rounded_to_float32(x, scale_));
  }

 private:
  Scale scale_;
  std::optional<IntersectionFinder> rounded_;
};

}  // namespace unsnarl
