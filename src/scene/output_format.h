#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/scale.h"
#include "geometry/types.h"
#include "scene/prepared_surface.h"
#include "scene/scene.h"
#include "unsnarl/intersections.h"
#include "unsnarl/repair.h"

namespace unsnarl {

// The numbers that a file will hold: which positions they can be, and the gap that keeps surfaces apart in them.
// Positions x are at a scale other than the file's (PreparedSurface::scale).

/// Can float32 hold these positions, however coarsely?
bool fits_float32(const Positions& x, const Scale& scale);
/// Coordinates beyond float32 become its largest number, since predicates need numbers.
Positions rounded_to_float32(const Positions& x, const Scale& scale);
/// Rounds those of these numbers of a file that are not what they are in the input (as many).
void round_changed_to_float32(std::span<const double> input, std::span<double> numbers);

/// The gap between surfaces around these vertices that rounding leaves open: a few units in the last place of the
/// format. By these vertices alone, so that distant parts change nothing.
double gap_of_format(const Scene& scene, std::span<const Index> vertices, bool float32, const Scale& scale);

/// Is float32 fine enough for the scene? Only the conflicts count, so that distant parts without any change nothing.
bool float32_can_hold(const Scene& scene, std::span<const IntersectingPair> pairs, const Scale& scale);

/// What is asked of the result's numbers: their digits, and the gap between surfaces. Its arguments must outlive it.
class OutputFormat {
 public:
  OutputFormat(const SurfaceView& surface, const PreparedSurface& prepared, const RepairOptions& options);

  /// Chooses the digits for a scene in which these pairs intersect: those asked for; else float32 where it can hold
  /// every group of the scene.
  void choose(const Scene& scene, std::span<const IntersectingPair> pairs);
  /// The result is to hold in float32.
  bool float32() const { return float32_; }
  /// float32 is optional: if no repair holds in it, the result is written in float64.
  bool may_give_up_float32() const { return float32_ && is_optional_; }
  /// Asks for float64 from now on.
  void give_up_float32() { float32_ = is_optional_ = false; }

  /// The numbers of the file that will be written for x, as a reader sees them: 3 a vertex of the file.
  std::vector<double> written(const Positions& x) const;
  /// The positions of the welded vertices that a reader of this file sees.
  Positions as_written(const Positions& x) const;
  /// The gap wanted between surfaces around these vertices, a length.
  double wanted_gap(const Scene& scene, std::span<const Index> vertices) const;

 private:
  SurfaceView surface_;
  const PreparedSurface* prepared_;
  const RepairOptions* options_;
  bool float32_ = false, is_optional_;
  double least_gap_;  // asked for, a length
};

}  // namespace unsnarl
