#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "unsnarl/intersections.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Findings of an exact check of given positions. Welding is that of the *input*, so vertices that have come to
/// coincide since intersect. Polygons count as the input is cut, and as a program cuts them that reads these positions.
struct Certificate {
  PairCounts pairs;    ///< intersecting pairs of faces, without those that are allowed
  PairCounts allowed;  ///< intersecting pairs of FindOptions::allowed
  /// The same after rounding all positions to float32; what is beyond its range counts as one degenerate pair. Unset:
  /// not looked for.
  std::optional<PairCounts> pairs_float32;
  std::size_t new_zero_area_faces = 0;  ///< triangles without area that had some in the input
  bool seams_closed = true;             ///< welded vertices are at one position

  /// Nothing is left to resolve: no two faces meet anywhere but in the hull of the vertices they share, or are allowed
  /// to.
  bool resolved() const { return pairs.total() == 0 && new_zero_area_faces == 0 && seams_closed; }
  /// The promise: no two faces meet anywhere but in the hull of the vertices they share.
  bool embedded() const { return resolved() && allowed.total() == 0; }
  bool float32_embedded() const { return pairs_float32 && pairs_float32->total() == 0; }
};

/// Decides exactly whether `positions` (3 n doubles, vertex order of `input`) embed the input's faces.
///
/// Throws std::invalid_argument when the number of positions differs or a coordinate is not finite.
Certificate certify(const SurfaceView& input, std::span<const double> positions, const FindOptions& options = {});

/// The same for several sets of positions of one input, search by search. The arrays of the input must outlive it.
class Certifier {
 public:
  /// Throws as find_intersections does.
  explicit Certifier(const SurfaceView& input, const FindOptions& options = {});
  Certifier(Certifier&&) noexcept;
  Certifier& operator=(Certifier&&) noexcept;
  ~Certifier();

  // Each takes 3 n doubles and throws std::invalid_argument as certify() does.

  /// All pairs of faces that intersect at these positions, sorted by (a, b), without those that are allowed.
  std::vector<IntersectingPair> find_intersections(std::span<const double> positions);
  /// The intersecting pairs that are allowed, sorted by (a, b); none where FindOptions::allowed is empty.
  std::vector<IntersectingPair> find_allowed_pairs(std::span<const double> positions);
  /// Everything but Certificate::pairs_float32, which stays unset.
  Certificate certify(std::span<const double> positions);
  /// Certificate::pairs_float32.
  PairCounts pairs_in_float32(std::span<const double> positions);

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace unsnarl
