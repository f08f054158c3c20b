#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/document.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// A polyline in the plane.
struct Curve {
  std::vector<double> points;  ///< 2 n doubles, x and y in turns; n >= 2 (open), n >= 3 (closed)
  bool closed = false;         ///< the last point is joined to the first, which is not repeated
  /// One flag a point, nonzero: must not move. Empty: all may move.
  std::vector<std::uint8_t> fixed;
  std::string name;      ///< for messages, such as "path 'outline'"; empty: the number of the curve
  double tolerance = 0;  ///< length: how far the polyline may be from the curve that it stands for; >= 0

  std::size_t size() const { return points.size() / 2; }
};

/// Two segments that meet anywhere but in a point that they share. Touching counts. Segment k of a curve starts at its
/// point k.
struct CurveCrossing {
  std::int32_t curve_a = 0, segment_a = 0;
  std::int32_t curve_b = 0, segment_b = 0;

  friend auto operator<=>(const CurveCrossing&, const CurveCrossing&) = default;
};

/// Points of curves that are one point and stay so: ends of open curves, and what they end on.
using CurveJoint = std::vector<std::array<std::int32_t, 2>>;  ///< {curve, point}, sorted

/// All pairs of segments that meet where they should not, sorted, by exact arithmetic. The points of a joint count as
/// one as far as they are at one position, bit for bit; nothing else does.
/// Throws std::invalid_argument as untangle_curves does.
std::vector<CurveCrossing> find_crossings(std::span<const Curve> curves, std::span<const CurveJoint> joints = {});

struct CurveOptions {
  /// Distance that curves keep from each other where a crossing was opened / diagonal of the bounding box: four pixels
  /// in a drawing of 1,000. Where points are closer than it along a curve, or curves are pressed together, less is
  /// kept. (0, 0.1]
  double gap_rel = 4e-3;
  /// An open curve that ends this close to another one ends *on* it, and stays there / diagonal. Flattened curves add
  /// their own tolerance. [0, 0.1]
  double junction_rel = 1e-9;
  bool fix_ends = false;  ///< the ends of open curves must not move
  /// false: curves are joined in another way at their crossings, where they get points, so that the drawing stays.
  /// true: every curve keeps its points, in their order, and strands are moved past each other
  bool move_strands = false;
  bool recover = true;      ///< false: stop once nothing crosses, without moving back toward the input
  double time_limit_s = 0;  ///< wall-clock seconds; 0: none
};

struct CurveReport {
  std::size_t crossings_before = 0, crossings_after = 0;  ///< pairs of segments, as find_crossings counts them
  std::size_t points = 0;                                 ///< of all curves, those inserted included
  double diagonal = 0;                                    ///< of the input's bounding box: the unit of all `_rel`
  /// How far points are from where they were in the input: mean over the length of the curves, and the largest.
  double displacement_mean_rel = 0, displacement_max_rel = 0;
  /// How far the result is from the nearest place of the input's drawing, all along its segments.
  double distance_mean_rel = 0, distance_max_rel = 0;
  /// How far the input is from the nearest place of the result's drawing, all along its segments.
  double drawing_distance_mean_rel = 0, drawing_distance_max_rel = 0;
  double drawing_lost = 0;            ///< share of the input's length that is farther than 0.005 from the result
  std::size_t turned_points = 0;      ///< points that are passed backwards, or by another curve
  std::size_t moved_points = 0;       ///< points that are not bit-identical to the input
  std::size_t inserted_points = 0;    ///< points added beside crossings, and where an open curve ends on a segment
  std::vector<CurveJoint> joints;     ///< in terms of the result's curves
  std::vector<CurveCrossing> before;  ///< crossings of `joined`
  std::vector<CurveCrossing> fixed;   ///< obstructions: crossings of segments that must not move
  std::vector<CurveCrossing> left;    ///< crossings of the result, the obstructions included
  double seconds = 0;
};

struct CurveResult {
  /// embedded: nothing crosses, by exact arithmetic. obstructed: only segments that must not move do. reduced,
  /// no_progress: crossings are left. time_limit, cancelled: stopped with crossings left.
  Status status = Status::no_progress;
  /// As many as in the input, open or closed as there; joined in another way at crossings and moved, with points
  /// inserted beside crossings and where an open curve ends on a segment.
  std::vector<Curve> curves;
  std::vector<Curve> joined;  ///< the same before anything moved: the input with its open ends joined
  CurveReport report;
};

/// Joins curves in the plane in another way at their crossings and moves their points as little as possible until no
/// two segments meet but in points that they share (paper §3.1.1). Never gives back more crossings than the input has;
/// curves without any come back unchanged. The same input gives the same result on every run. docs/curves.md explains
/// the method.
///
/// Throws std::invalid_argument, naming the curve and the point, for curves with too few points, coordinates that are
/// not finite or beyond 1e70, a diagonal below 1e-70, segments without length, flags of another number than points, or
/// an option out of range.
CurveResult untangle_curves(std::span<const Curve> curves, const CurveOptions& options = {},
                            Context* context = nullptr);

/// The report as a JSON object: status, exit code, counts, displacements, obstructions and crossings left
/// (docs/curves.md explains the keys).
std::string curve_report_json(const CurveResult& result);

enum class CurveFormat : std::uint8_t { svg, json };
std::string_view to_string(CurveFormat format);
/// By the extension of a path, or the bare name. Case does not matter.
std::optional<CurveFormat> curve_format_from_extension(std::string_view path);

/// How a curve that moved is written in a file with Bézier curves.
enum class CurveWriting : std::uint8_t {
  smooth,    ///< Béziers where its points did not move, and joined by Béziers without kinks where they did
  beziers,   ///< Béziers where its points did not move, segments where they did
  polyline,  ///< point by point
};

/// A file of curves with its bytes: curves out, moved curves patched back in, every other byte as it was.
///
/// SVG: path, polyline, polygon, line, rect, circle and ellipse elements with their transforms; what is only referred
/// to (defs, symbol, clipPath, mask, marker, pattern) is left alone. Béziers and arcs are flattened. An element of
/// which nothing moved keeps its bytes; one that moved keeps all but its geometry, and becomes a path where it was a
/// line, rect, circle or ellipse. Where its points did not move, Béziers and arcs are Béziers again.
/// JSON: {"curves": [{"points": [[x, y], ...], "closed": true, "fixed": true or [point, ...], "name": "..."}, ...]};
/// only "points" is needed.
class CurveDocument {
 public:
  /// flatten_rel: how far a flattened Bézier or arc may be from the true curve / diagonal, (0, 0.1].
  /// Both throw FileError, which names the line or byte.
  static CurveDocument read(const std::string& path, double flatten_rel = 1e-4, std::optional<CurveFormat> format = {});
  static CurveDocument parse(std::string bytes, CurveFormat format, double flatten_rel = 1e-4);

  CurveDocument(CurveDocument&&) noexcept;
  CurveDocument& operator=(CurveDocument&&) noexcept;
  ~CurveDocument();

  CurveFormat format() const;
  const std::vector<Curve>& curves() const;
  /// The id of the element that each curve comes from (SVG) or its name (JSON); empty where there is none.
  const std::vector<std::string>& ids() const;
  const std::vector<std::string>& notes() const;  ///< things worth telling the user, one sentence each

  /// The file with these curves in place of its own: as many, closed where they were, points moved or inserted.
  /// Coordinates that moved are rounded to 1e-9 of the diagonal, unless all digits are asked for: where curves are
  /// closer than that, only these keep them apart. Points at one position are read as one position again; only where
  /// elements of a drawing have different transforms can it happen that no doubles say so.
  /// writing: of each curve, how it is written if it moved; empty: all smooth.
  std::string patched(std::span<const Curve> curves, bool all_digits = false,
                      std::span<const CurveWriting> writing = {}) const;
  /// The curves of a file that patched() wrote, Béziers flattened as here, or to within this part of that tolerance,
  /// (0, 1]; there they may have other points. Throws FileError.
  std::vector<Curve> read_back(const std::string& bytes, double part_of_tolerance = 1) const;

 private:
  CurveDocument(CurveFormat format, std::unique_ptr<class CurveFile> file);
  CurveFormat format_;
  std::unique_ptr<class CurveFile> file_;
};

/// Certifies the bytes of a file that patched() wrote for a result: it has the curves and joints of the result, point
/// by point or, where there are Béziers, no farther from it than ten times the tolerance of flattening; and no more
/// crossings than the result says, counted on the numbers that are read back, by exact arithmetic. Returns what does
/// not hold; empty: all holds. Throws FileError.
std::string curve_file_faults(const CurveDocument& document, const std::string& bytes, const CurveResult& result);

/// The bytes of a file for a result, by patched(): as many curves are written smoothly, and as few digits, as the
/// certificate allows, and as do not cross either where they are cut sixteen times as finely. curve_file_faults() says
/// whether the certificate holds then. Throws FileError.
std::string written_curves(const CurveDocument& document, const CurveResult& result);

/// The integrand of the Gaussian self-contact energy over pairs of points of one curve (paper eq. (1), Fig. 4), with
/// the intrinsic distance as weight: w(s, t) / epsilon exp(-|y(s) - y(t)|^2 / epsilon^2), as the bytes of a PNG of
/// size x size pixels, dark where it is zero. epsilon_rel: bandwidth / diagonal, > 0. size: [64, 4096].
std::string curve_integrand_png(const Curve& curve, double epsilon_rel = 0.05, int size = 800);

/// Before and after side by side, the places of crossings marked in red, as the bytes of an SVG file.
std::string curve_picture_svg(std::span<const Curve> before, std::span<const CurveCrossing> crossings_before,
                              std::span<const Curve> after, std::span<const CurveCrossing> crossings_after);

/// A closed curve that crosses itself, made from a seed; points [8, 100000]. The same on every machine.
/// kind: "waves" (sums of a few sines), "walk" (a smoothed random walk), "star" (a spline through random points),
/// "noise" (a circle with noise of several edge lengths), "spiral" (turns many times), "chaos" (random points joined at
/// random). Throws std::invalid_argument for another kind or number.
Curve random_closed_curve(std::string_view kind, std::uint64_t seed, int points);
std::span<const std::string_view> random_curve_kinds();

}  // namespace unsnarl
