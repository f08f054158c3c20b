#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/intersections.h"
#include "unsnarl/paper.h"
#include "unsnarl/recording.h"
#include "unsnarl/report.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// The pairs that a repair has to resolve.
enum class Goal : std::uint8_t {
  all,       ///< no intersecting pair of any class
  disjoint,  ///< no pair of faces that share no vertex (the criterion of the paper)
};

/// Cancellation and progress, shared with other threads.
class Context {
 public:
  struct Progress {
    double fraction = 0;          ///< in [0, 1], never decreases
    std::string_view phase;       ///< "diagnose", "place" (rigid parts), "untangle", "recover", "open_gaps", "certify"
    std::size_t pairs_left = 0;   ///< intersecting pairs of faces at this moment, as reports count them
    double displacement_rel = 0;  ///< largest displacement at this moment / bounding-box diagonal
  };

  /// Safe to call from any thread and from a signal handler.
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  bool is_cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }

  /// Called from the thread that runs the repair, a few times a second at most.
  std::function<void(const Progress&)> on_progress;

 private:
  std::atomic<bool> cancelled_{false};
};

struct RepairOptions {
  // Everybody uses these.

  FindOptions find;  ///< welding, what may pass through each other, threads
  Goal goal = Goal::all;
  /// One flag a vertex, nonzero: must not move, nor the vertices welded to it. Empty: all may move.
  std::vector<std::uint8_t> fixed;
  /// One number a vertex: the rigid part that it belongs to, with the vertices welded to it, counted from 0; -1: none.
  /// A rigid part is turned and shifted as one body and never deformed. It moves where it intersects what is fixed or
  /// another rigid part; to what is soft it gives way only where that could not be repaired around it. Empty: no part
  /// is rigid. Not together with each_component, nor with `fixed` on the same vertices.
  std::vector<std::int32_t> rigid;
  std::vector<std::string> rigid_names;  ///< of these parts, for reports; missing ones are their numbers
  bool each_component = false;  ///< repair every component as if alone; what runs through others may do so still
  /// Wanted gap between sheets / bounding-box diagonal, at most 8 mean widths of the faces (GapTooWide). Gaps that are
  /// too small are opened, also where nothing intersects; see GapReport for what a gap is. 0: where faces intersect, a
  /// few units in the last place of the precision in which the result holds.
  double min_gap_rel = 0;
  bool gap_near_conflicts = false;  ///< open gaps only around what intersects, measure none, and promise none
  /// Two faces at an edge that are folded together closer than this angle, in degrees, in [0, 90), are opened to it
  /// after the repair, as far as nothing is in the way; also where nothing intersects. 0: left as they are.
  double min_dihedral_deg = 0;
  double max_displacement_rel = 0;  ///< no vertex moves farther / bounding-box diagonal; 0: any
  double time_limit_s = 0;          ///< wall-clock seconds; 0: none
  /// MB (10^6 bytes) of resident memory, looked at all the time; 0: none. To be sure that it is never passed, limit
  /// the process too: an allocation that fails ends the work with Status::memory_limit and what was reached.
  double memory_limit_mb = 0;

  // Programs use these that write files or show how a repair went.

  /// Format in which the result has to hold. Unset: float32 wherever the input's coordinates allow it and a way to it
  /// is found, else float64. Where float32 is set and the result does not hold in it, or a coordinate is beyond its
  /// range, the status is not embedded.
  std::optional<Precision> precision;
  /// The positions that a reader of the file to be written will see, given those to be written and whether float32
  /// digits are enough. Unset: rounded to `precision`. The result is certified as it returns them.
  std::function<std::vector<double>(std::span<const double> positions, bool float32)> as_written;
  RecordOptions record;  ///< what to note on the way; nothing unless asked for

  // Research uses these.

  bool recover = true;  ///< false: stop after untangling
  /// Untangles and recovers as the paper does, instead of region by region. Unset: region by region.
  std::optional<PaperOptions> paper;
  /// Names of strategies (RegionReport::strategy) to do without: what each is worth. Unknown ones are an error.
  std::vector<std::string> without_strategies;
};

/// RepairOptions::min_gap_rel is more than 8 times as wide as the faces, by the mean side of equilateral triangles of
/// their areas; with RepairOptions::gap_near_conflicts only where the surface intersects itself or dihedral angles are
/// to be opened.
class GapTooWide : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

struct RepairResult {
  Status status = Status::no_progress;
  std::vector<double> positions;  ///< 3 n doubles, vertex order of the input
  RepairReport report;
  std::vector<RecordedFrame> frames;  ///< from the input to `positions`; empty unless asked for
};

/// Moves the vertices as little as possible so that no two faces intersect; connectivity is kept.
///
/// Nothing is lost where memory runs out on the way, and the status says so (memory_limit), also of a result that is
/// embedded; std::bad_alloc is thrown only if there is not even enough to find the input's intersections. Never returns
/// positions with more intersecting pairs than the input; pairs of FindOptions::allowed do not count. The same input
/// and options give the same bytes at any thread count (time limits and cancellation aside).
///
/// Throws std::invalid_argument when a corner names a vertex that does not exist, a coordinate is not finite, or an
/// option is out of range, GapTooWide among them; LimitReached where a limit ends the search for the input's
/// intersections, which thousands of faces do not take long for.
RepairResult repair(const SurfaceView& surface, const RepairOptions& options = {}, Context* context = nullptr);

}  // namespace unsnarl
