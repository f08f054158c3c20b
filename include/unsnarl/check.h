#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "unsnarl/intersections.h"
#include "unsnarl/limit_reached.h"
#include "unsnarl/report.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Axis-aligned box, closed, in the units of the positions. Default: empty, min > max.
struct Bounds {
  std::array<double, 3> min = {infinity, infinity, infinity}, max = {-infinity, -infinity, -infinity};

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

/// Intersecting faces that are connected, by pairs or by shared vertices.
struct ConflictPlace {
  std::size_t pairs = 0;
  std::vector<std::int32_t> faces;  ///< ids, ascending
  Bounds bounds;                    ///< of these faces
};

/// A component (see component_of_faces) and the pairs that its faces are in.
struct ComponentFindings {
  std::int32_t first_face = 0;
  std::size_t faces = 0;
  std::size_t vertices = 0;           ///< as the mesh counts them, before welding
  std::size_t pairs_within = 0;       ///< of two of its faces
  std::size_t pairs_with_others = 0;  ///< of a face of it and one of another component
  Bounds bounds;
};

/// Limits of a check.
struct CheckLimits {
  double time_limit_s = 0;     ///< wall-clock seconds; 0: none
  double memory_limit_mb = 0;  ///< MB (10^6 bytes) of resident memory, looked at all the time; 0: none
  /// So many pairs are listed, the first of all; everything is counted. Without a list, memory does not follow the
  /// number of pairs.
  std::size_t pairs_listed = std::numeric_limits<std::size_t>::max();
};

/// The findings of `unsnarl check`.
struct CheckReport {
  std::vector<IntersectingPair> pairs;  ///< as find_intersections gives them, CheckLimits::pairs_listed at most
  PairCounts counts;
  PairCounts allowed;  ///< intersecting pairs of FindOptions::allowed, which nothing else here counts
  std::vector<IntersectingPair> allowed_pairs;  ///< these, sorted, CheckLimits::pairs_listed at most
  std::vector<std::int32_t> faces;              ///< in any pair, ids, ascending
  std::vector<ConflictPlace> places;            ///< most pairs first
  Topology topology;
  std::vector<ComponentFindings> components;                 ///< in the order of their first faces
  std::vector<OverlappingComponent> overlapping_components;  ///< in the order of their numbers
  std::size_t closed_non_orientable = 0;                     ///< components that have no embedding in space
  std::size_t intersecting_components = 0;                   ///< with a face in any pair
  std::size_t pairs_within_components = 0;                   ///< of two faces of one component
  std::optional<GapReport> gap;                              ///< see measure_gap(); none: check() does not measure it
  std::string triangulation;  ///< how the polygons were split into triangles, one sentence
};

/// Counts and locates the self-intersections of a surface. Throws as find_intersections does, LimitReached, and
/// std::invalid_argument where a limit is negative.
CheckReport check(const SurfaceView& surface, const FindOptions& options = {}, const CheckLimits& limits = {});

}  // namespace unsnarl
