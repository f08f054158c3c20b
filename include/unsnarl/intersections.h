#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "unsnarl/surface.h"

namespace unsnarl {

/// How two faces that meet outside the hull of the vertices they share are related. Counted apart everywhere.
enum class PairClass : std::uint8_t {
  disjoint,    ///< the faces share no vertex (the criterion of the paper)
  one_vertex,  ///< they share one vertex and meet elsewhere too
  folded,      ///< they share an edge and overlap flat
  duplicate,   ///< they have the same three vertices
  degenerate,  ///< at least one of them has zero area
  count,       ///< no class: how many there are; a new one comes before it
};
inline constexpr auto pair_class_count = static_cast<std::size_t>(PairClass::count);
inline constexpr std::array<std::string_view, pair_class_count> pair_class_names = {"disjoint", "one_vertex", "folded",
                                                                                    "duplicate", "degenerate"};
static_assert(!pair_class_names.back().empty(), "every PairClass has a name");

/// Two intersecting faces, a < b. Touching counts as intersecting.
struct IntersectingPair {
  std::int32_t a = 0;
  std::int32_t b = 0;
  PairClass kind = PairClass::disjoint;

  friend auto operator<=>(const IntersectingPair&, const IntersectingPair&) = default;
};

/// Number of pairs in each class, indexed by PairClass.
struct PairCounts {
  std::array<std::size_t, pair_class_count> by_class{};

  std::size_t operator[](PairClass kind) const { return by_class[static_cast<std::size_t>(kind)]; }
  std::size_t& operator[](PairClass kind) { return by_class[static_cast<std::size_t>(kind)]; }
  std::size_t total() const;
};

/// Which vertices count as one. Decided on the input; never changes the file.
enum class Weld : std::uint8_t {
  none,   ///< every vertex by itself
  seams,  ///< ends of open edges (of one face) at exactly equal positions: UV seams, split normals, STL corners
  all,    ///< all vertices at exactly equal positions
};

/// Faces that may pass through each other. To every search their pairs are no intersections; they are counted apart.
struct AllowedPairs {
  /// The part that each face is of, counted from 0; -1: none. Empty: no pair is allowed.
  std::vector<std::int32_t> part_of_face;
  /// Pairs of parts whose faces may pass through each other; a part twice: its own faces may.
  std::vector<std::array<std::int32_t, 2>> parts;

  bool empty() const { return part_of_face.empty() || parts.empty(); }
};

struct FindOptions {
  Weld weld = Weld::seams;
  double weld_tolerance = 0;  ///< length, in the units of the positions: vertices this close count as equal. >= 0
  /// Quads have two diagonals: count two faces as intersecting where they do for any choice of them (a diagonal that
  /// folds its quad left out). Readers of the file may choose either.
  bool both_diagonals = false;
  AllowedPairs allowed = {};  ///< of which no pair is an intersection
  int threads = 0;            ///< 0: as many as the machine has. >= 0
};

/// All pairs of faces that intersect and may not, sorted by (a, b), decided by exact predicates. Ids are those of the
/// given faces (polygons, not their triangles); a polygon that meets itself is reported with a == b.
///
/// Throws std::invalid_argument when a corner names a vertex that does not exist, a coordinate is not finite, or an
/// option is out of range.
std::vector<IntersectingPair> find_intersections(const SurfaceView& surface, const FindOptions& options = {});

PairCounts count_by_class(const std::vector<IntersectingPair>& pairs);

/// Ids of the faces in any of the pairs, ascending.
std::vector<std::int32_t> intersecting_faces(const std::vector<IntersectingPair>& pairs);

}  // namespace unsnarl
