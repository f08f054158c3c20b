#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/intersections.h"
#include "unsnarl/recording.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// How a repair ended. Only `embedded` and `gap_not_met` promise a surface without self-intersections, `allowed` one
/// that has none but those of FindOptions::allowed.
enum class Status : std::uint8_t {
  embedded,     ///< no two faces meet anywhere but in the hull of the vertices they share
  reduced,      ///< fewer intersecting pairs than the input, but not none
  no_progress,  ///< nothing better than the input was found; positions are the input's
  obstructed,   ///< everything else repaired; only the listed obstructions remain
  allowed,      ///< embedded but for pairs of faces that may pass through each other (FindOptions::allowed)
  time_limit,   ///< stopped by RepairOptions::time_limit_s
  /// Stopped by RepairOptions::memory_limit_mb, or an allocation failed. What is left is counted; where that is
  /// nothing, vertices may lie farther from the input than they need.
  memory_limit,
  /// Some self-intersections are left, since resolving them moves a vertex too far; or a vertex of the result is
  /// farther away than allowed, also where no self-intersection is left.
  displacement_exceeded,
  cancelled,    ///< stopped by Context::cancel
  gap_not_met,  ///< embedded, but the smallest gap fell short of RepairOptions::min_gap_rel by more than 1 %
};
std::string_view to_string(Status status);
/// No pair is left that had to be resolved: embedded, whatever the gaps, or allowed.
constexpr bool is_resolved(Status status) {
  return status == Status::embedded || status == Status::gap_not_met || status == Status::allowed;
}

/// Number format the repaired positions must stay embedded in.
enum class Precision : std::uint8_t { float32, float64 };
std::string_view to_string(Precision precision);

/// Diagonal of the bounding box, in the units of the positions, at most the largest double; 0 without vertices. The
/// unit of every length `*_rel`.
double diagonal_of(const SurfaceView& surface);

/// Something that no motion of the vertices can resolve, or that the options forbid to.
struct Obstruction {
  enum class Kind : std::uint8_t {
    closed_non_orientable,  ///< a closed non-orientable component has no embedding in space
    duplicate_faces,        ///< several faces on the same three vertices
    fixed_faces,            ///< faces that intersect in what their fixed vertices span: these, edges, whole faces
    between_components,     ///< faces of different components, which RepairOptions::each_component leaves
    rigid_faces,            ///< faces that intersect in what their vertices of one rigid part span
  };
  Kind kind;
  std::vector<std::int32_t> faces;  ///< the faces concerned (input ids); a whole component is named by its first face
  std::string message;              ///< one sentence for a person
};
std::string_view to_string(Obstruction::Kind kind);

/// Connectivity of the input, after welding.
struct Topology {
  std::size_t vertices = 0, faces = 0, triangles = 0, components = 0;
  std::size_t boundary_edges = 0, non_manifold_edges = 0, non_manifold_vertices = 0;
  std::size_t duplicate_faces = 0, zero_area_faces = 0, duplicate_vertices = 0, unused_vertices = 0;
  std::size_t closed_components = 0, non_orientable_components = 0;
};

/// One conflict region and how it was resolved.
struct RegionReport {
  /// Name of the strategy that resolved it, or these pairs of it; "none" where all failed, "nesting" for the push of
  /// repair_nested(), "paper" with RepairOptions::paper.
  std::string strategy;
  std::size_t faces = 0;  ///< triangles that were free to move; polygons count as those they are split into
  std::size_t pairs = 0;  ///< of triangles: resolved; with "none", left; with "paper", at its start
  int iterations = 0;
  double seconds = 0;
  /// Overlap depth: largest distance between a vertex of the first intersection-free state found and its input
  /// position / bounding-box diagonal.
  double depth_rel = 0;
  /// Largest distance between a vertex of the region and its input position in the result / bounding-box diagonal, and
  /// which vertex of the input that is; -1: none moved.
  double displacement_rel = 0;
  std::int32_t farthest_vertex = -1;
};

/// The state that the method of the paper (RepairOptions::paper) reached by untangling, before recovery.
struct PaperUntangling {
  bool is_clean = false;  ///< no two faces that share no vertex intersect: the paper's criterion
  /// Over the vertices, from their input positions, as RepairReport has them of the result.
  double displacement_mean_rel = 0, displacement_max_rel = 0;
};

/// A component with self-intersections of its own, before or after.
struct ComponentReport {
  std::size_t component = 0;  ///< number in the order of the first faces (see component_of_faces)
  std::int32_t first_face = 0;
  std::size_t pairs_before = 0, pairs_after = 0;  ///< intersecting pairs of its faces among each other
};

/// A closed component of the input of which more than large_overlap_share lies inside others that it intersects.
struct OverlappingComponent {
  std::size_t component = 0;  ///< number in the order of the first faces (see component_of_faces)
  std::int32_t first_face = 0;
  /// The name that the file gives to the part of its first face, see part_of_face(); empty: none.
  std::string name = {};
  double volume_share = 0;  ///< of its volume inside others; estimated, some hundredths off
};
/// Share of the volume of a component from which its overlap is listed (fixed by the report).
inline constexpr double large_overlap_share = 0.1;
/// One sentence for a person: how many they are, and what can be done; options as the command line calls them. Empty
/// where there are none.
std::string advice_on_overlaps(std::span<const OverlappingComponent> overlapping);

/// A component that has lost more than 5 % of its volume or area, has turned by more than 5 degrees, has moved far (by
/// more than twice the depth of its overlap, with the gap that was asked for, and by more than 1 % of its own bounding
/// box), or has new creases on more than 2 % of its area.
struct ChangedComponent {
  std::size_t component = 0;  ///< number in the order of the first faces (see component_of_faces)
  std::int32_t first_face = 0;
  std::string name = {};  ///< as of OverlappingComponent
  bool has_shrunk = false, is_turned = false, is_far = false, is_creased = false;
  bool is_closed = false;  ///< and its faces agree on what is inside: it has a volume
  /// Change of the signed volume of a closed component, of the area of any other: after / before - 1. -1: nothing is
  /// left; less: it is turned inside out.
  double size_change_rel = 0;
  double rotation_deg = 0;      ///< of the rigid motion that fits best, by squared distances over the area; in [0, 180]
  double displacement_rel = 0;  ///< of the vertex that moved farthest / bounding-box diagonal
  std::int32_t farthest_vertex = 0;
  /// Depth of its overlap with other components in the input / bounding-box diagonal: the largest distance between a
  /// vertex of one that is inside the other, where this is closed, and the surface of the other; at least the depth of
  /// the deepest pair of triangles that share no vertex. None: it intersects itself, or an open component while it is
  /// open itself, so that the depth is not known; then is_far is false.
  std::optional<double> depth_rel = {};
  /// Share of its area in the input that belongs to triangles at a new crease: an edge of two triangles whose normals
  /// are farther apart than in the input by more than 45 degrees. The same crease takes less of a finer mesh.
  double creased_share = 0;
};
/// "component 3 (jaw) lost 57 % of its volume, turned by 12 degrees". `diagonal`: RepairReport::diagonal.
std::string describe(const ChangedComponent& changed, double diagonal);

/// How a rigid part moved (RepairOptions::rigid): a vertex at p in the input is at R p + t in the result.
struct RigidPartReport {
  std::string name;
  std::size_t vertices = 0;                                      ///< of the input
  std::array<double, 9> rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< R, row after row
  std::array<double, 3> translation = {0, 0, 0};                 ///< t, a length
  double rotation_deg = 0;                                       ///< angle of R, in [0, 180]
  double translation_rel = 0;                                    ///< motion of the mean of its vertices / diagonal
  /// Largest distance of a vertex of the result from R p + t / diagonal: what rounding to the digits of the result
  /// does.
  double residual_rel = 0;
};

/// Why two faces still intersect; the first that holds.
enum class LeftReason : std::uint8_t {
  closed_non_orientable,  ///< of a component that has no embedding in space
  duplicate_faces,        ///< on the same three vertices
  fixed_faces,            ///< what their fixed vertices span intersects
  between_components,     ///< of different components, which RepairOptions::each_component leaves
  goal,                   ///< of a class that RepairOptions::goal does not ask for
  rounding,               ///< were separated, by less than the digits of the result can tell apart
  displacement,           ///< were separated, but a vertex had moved farther than allowed
  taken_back,             ///< were separated, but the whole result had more pairs than the input
  time_limit,             ///< not resolved when the limit was reached
  memory_limit,
  cancelled,
  unresolved,  ///< no strategy separated them
  /// Meet only where polygons are split along other diagonals than in the input: as a program splits them that reads
  /// the result, or quads along either (FindOptions::both_diagonals).
  other_diagonal,
  rigid_faces,  ///< what their vertices of one rigid part span intersects
  count,        ///< no reason: how many there are; a new one comes before it
};
inline constexpr auto left_reason_count = static_cast<std::size_t>(LeftReason::count);
/// Its name in reports.
std::string_view to_string(LeftReason reason);
/// Words for a person that follow "5 intersections "; they name options as the command line does.
std::string_view describe(LeftReason reason);

/// Two faces that intersect in the result, a <= b.
struct LeftPair {
  std::int32_t a = 0, b = 0;
  PairClass kind = PairClass::disjoint;
  LeftReason reason = LeftReason::unresolved;
  std::string strategy;  ///< unresolved: name of the furthest strategy that was tried; else empty
};
/// report_json() lists so many of the pairs that are left at most; it counts all.
inline constexpr std::size_t most_left_pairs_listed = 1000;

/// The smallest gap between two sheets of the result, where RepairOptions asks for gaps everywhere. Two sheets are two
/// components, or parts of one that are not near along the surface in the input. Of one sheet are faces that share a
/// vertex or that a third one joins, and those that the surface joins within a ball around the middle between them; its
/// radius is the gap asked for, or 4 times their distance if that is more.
struct GapReport {
  double asked_rel = 0;  ///< RepairOptions::min_gap_rel
  /// Computed in double from the positions as they are written / bounding-box diagonal; infinite: no gap is less than
  /// twice what was asked for.
  double smallest_rel = std::numeric_limits<double>::infinity();
  std::array<std::int32_t, 2> faces = {-1, -1};  ///< the two; -1: there are none
  std::array<double, 3> position = {0, 0, 0};    ///< the middle between their closest points
  bool is_between_held = false;                  ///< none of their vertices may move, or all are of one rigid part

  /// Falls short by 1 % at most.
  bool is_met() const { return smallest_rel >= 0.99 * asked_rel; }
};

struct StageReport {
  std::string name;
  double seconds = 0;         ///< of the clock
  double cpu_seconds = 0;     ///< of the processors, by all threads of the process
  double peak_memory_mb = 0;  ///< peak resident memory of the process at the end of the stage
};

struct RepairReport {
  Topology topology;
  std::string triangulation;                 ///< how the input's polygons were split into triangles, one sentence
  PairCounts before, after;                  ///< without pairs that are allowed; these:
  PairCounts allowed_before, allowed_after;  ///< pairs of FindOptions::allowed that intersect
  std::vector<Obstruction> obstructions;
  /// The pairs of `after`, sorted. Empty where memory ran out at the end.
  std::vector<LeftPair> left;
  std::array<std::size_t, left_reason_count> left_by_reason{};  ///< of all, indexed by LeftReason
  double diagonal = 0;                                          ///< of the input's bounding box; unit of every *_rel
  double displacement_mean_rel = 0, displacement_rms_rel = 0, displacement_max_rel = 0;  ///< over the vertices
  /// Root of the mean over the input's area of the squared motion, which is linear on each triangle: it does not depend
  /// on where vertices are many. Results are compared by it. 0 where the input has no area.
  double displacement_area_rms_rel = 0;
  /// No embedded result has a smaller displacement_max_rel: half the depth of the deepest single pair of triangles that
  /// share no vertex (obstructions aside). Seldom reached, because a whole neighbourhood has to make way.
  double displacement_lower_bound_rel = 0;
  double untouched_share = 1;                          ///< share of vertices that are bit-identical to the input
  std::size_t flipped_triangles = 0;                   ///< normals rotated by more than 90 degrees
  std::size_t flipped_triangles_without_conflict = 0;  ///< of these: not in an intersecting pair of the input
  double min_gap_rel = 0;                              ///< smallest gap met in recovery; 0: no contact was active
  std::optional<GapReport> gap;                        ///< none: no gap was asked for everywhere
  double volume_change_rel = 0;                        ///< of signed volumes, after / before - 1: of the component
                                                       ///< with a volume where it changed most
  double area_change_rel = 0;
  /// Edge lengths, max(after / before, before / after) over the edges of the triangles that the faces are split into:
  /// the largest, and the 99.9th percentile, which single needles do not decide. Edges without length in the input do
  /// not count; infinite where one has none left.
  double edge_stretch_max = 1, edge_stretch_p999 = 1;
  bool float32_embedded = false;             ///< holds after rounding all positions to float32
  Precision precision = Precision::float64;  ///< the format in which the result was made to hold
  std::vector<RegionReport> regions;
  std::optional<PaperUntangling> before_recovery;  ///< none: not by RepairOptions::paper
  std::vector<ComponentReport> components;
  std::vector<OverlappingComponent> overlapping_components;  ///< in the order of their numbers
  std::vector<ChangedComponent> changed_components;          ///< those that lost most first, then those that moved most
  std::vector<RigidPartReport> rigid_parts;                  ///< in the order of their numbers
  std::vector<RegionHistory> history;  ///< in the order of the work; empty unless RepairOptions::record asks for it
  std::vector<StageReport> stages;
};

}  // namespace unsnarl
