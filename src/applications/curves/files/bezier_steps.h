#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "applications/curves/files/path_data.h"

namespace unsnarl {

/// How a path goes on to a point of its curve: by a segment, or by a cubic Bézier curve with these two controls.
struct PathStep {
  std::size_t to = 0;
  std::optional<std::array<Vec2, 2>> controls;
};

/// The pieces of a drawing, found by the points that they join.
class DrawnPieces {
 public:
  /// A flattened curve of the drawing, with the pieces from each of its points to the next; in its coordinates.
  void add(const Curve& flattened, std::span<const DrawnPiece> pieces);

  /// The steps along a curve that has points of the drawing and others, from its point 0 on; of a closed curve the last
  /// one leads to point 0. Passed either way, neighbouring parts of one Bézier curve are one Bézier
  /// curve again; those of an arc too, to within 2e-7 of its radius, or of --flatten where its pieces are coarse. If
  /// `smooth` and a run of other points lies between two of them, it is joined to both by Bézier curves without kinks,
  /// within `tolerance` of its points; elsewhere there are segments. No curve goes past a point k of which is_stop(k).
  std::vector<PathStep> along(const Curve& curve, bool smooth, double tolerance,
                              const std::function<bool(std::size_t)>& is_stop) const;

 private:
  using Ends = std::array<double, 4>;
  struct Place {
    int curve = 0;  ///< in the order in which curves were added
    DrawnPiece piece;
  };
  std::vector<DrawnPiece> pieces_of(const Curve& curve, std::vector<int>& curve_of) const;

  std::map<Ends, std::vector<Place>> places_;  ///< both ways
  int curves_ = 0;
};

}  // namespace unsnarl
