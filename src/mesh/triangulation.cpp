#include "mesh/triangulation.h"

#include <algorithm>

#include "geometry/parallel.h"
#include "geometry/predicates.h"
#include "geometry/scale.h"
#include "geometry/sort_unique.h"
#include "mesh/ear_clipper.h"

namespace unsnarl {
namespace {

/// A task triangulates this many polygons, whatever the number of threads (unit: polygons)
constexpr std::size_t polygons_in_block = 8192;

/// Cuts polygons one after another, keeping its memory.
class PolygonCutter {
 public:
  PolygonCutter(const SurfaceView& surface, CutStatistics& statistics) : surface_(surface), statistics_(statistics) {}

  /// Calls emit(a, b, c) with the file vertices of each triangle.
  template <class Emit>
  void cut(std::span<const Index> corners, Emit&& emit) {
    if (corners.size() < 3) {
      ++statistics_.too_small;
    } else if (corners.size() == 3) {
      ++statistics_.triangles;
      emit(corners[0], corners[1], corners[2]);
    } else {
      gather(corners);
      if (corners.size() == 4)
        cut_quad(corners, emit);
      else
        clip_ears(corners, emit);
    }
  }

  /// The same for the other diagonal of a quad, if neither folds.
  template <class Emit>
  void cut_otherwise(std::span<const Index> corners, Emit&& emit) {
    if (corners.size() != 4) return;
    gather(corners);
    if (std::min({side(0, 1, 2), side(0, 2, 3), side(1, 2, 3), side(1, 3, 0)}) <= 0) return;
    emit_second_diagonal(corners, emit);
  }

 private:
  /// Takes the corners' positions at a scale of their own, so that a cut is the same at any power of two, and finds the
  /// mean normal.
  void gather(std::span<const Index> corners) {
    coordinates_.clear();
    for (const Index v : corners) {
      const auto p = surface_.positions.subspan(3 * static_cast<std::size_t>(v), 3);
      coordinates_.insert(coordinates_.end(), p.begin(), p.end());
    }
    const Scale scale(coordinates_);
    points_.clear();
    for (std::size_t k = 0; k < coordinates_.size(); k += 3)
      points_.emplace_back(scale.in(coordinates_[k]), scale.in(coordinates_[k + 1]), scale.in(coordinates_[k + 2]));
    normal_ = Vec3::Zero();
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Vec3 a = points_[k] - points_[0], b = points_[(k + 1) % points_.size()] - points_[0];
      normal_ += a.cross(b);
    }
  }

  /// Positive where the corners at these places turn left as seen against the mean normal.
  double side(int a, int b, int c) const { return turn(normal_, points_[a], points_[b], points_[c]); }

  template <class Emit>
  static void emit_second_diagonal(std::span<const Index> corners, Emit&& emit) {
    emit(corners[1], corners[2], corners[3]);
    emit(corners[1], corners[3], corners[0]);
  }

  template <class Emit>
  void cut_quad(std::span<const Index> corners, Emit&& emit) {
    ++statistics_.quads;
    const bool first_is_flat = std::min(side(0, 1, 2), side(0, 2, 3)) > 0;
    if (first_is_flat || std::min(side(1, 2, 3), side(1, 3, 0)) <= 0) {
      emit(corners[0], corners[1], corners[2]);
      emit(corners[0], corners[2], corners[3]);
    } else {
      ++statistics_.quads_other_diagonal;
      emit_second_diagonal(corners, emit);
    }
  }

  template <class Emit>
  void clip_ears(std::span<const Index> corners, Emit&& emit) {
    ++statistics_.clipped;
    triangles_.clear();
    statistics_.forced_ears += clipper_.clip(corners, points_, normal_, triangles_);
    for (const auto& [a, b, c] : triangles_) emit(corners[a], corners[b], corners[c]);
  }

  const SurfaceView& surface_;
  CutStatistics& statistics_;
  EarClipper clipper_;
  // Of one polygon.
  std::vector<double> coordinates_;  // of its corners, as they are given
  std::vector<Vec3> points_;         // its corners, scaled
  Vec3 normal_;                      // of these
  std::vector<Triangle> triangles_;  // as places of its corners
};

void add(CutStatistics& sum, const CutStatistics& part) {
  sum.triangles += part.triangles;
  sum.quads += part.quads;
  sum.quads_other_diagonal += part.quads_other_diagonal;
  sum.clipped += part.clipped;
  sum.forced_ears += part.forced_ears;
  sum.too_small += part.too_small;
  sum.dropped += part.dropped;
}

/// The segment or point of a triangle with a repeated vertex, smaller vertex first; {v, v} of a point.
Edge extent_of(const Triangle& t) {
  const auto [least, largest] = std::minmax({t[0], t[1], t[2]});
  return {least, largest};
}

/// The position of each vertex of the triangles: of the first file vertex that it is.
class CornerPositions {
 public:
  CornerPositions(const SurfaceView& surface, std::span<const Index> vertex_of) : surface_(surface) {
    for (std::size_t v = vertex_of.size(); v-- > 0;) {
      const auto welded = static_cast<std::size_t>(vertex_of[v]);
      if (welded >= file_vertex_of_.size()) file_vertex_of_.resize(welded + 1);
      file_vertex_of_[welded] = static_cast<Index>(v);
    }
  }
  bool has_area(const Triangle& t) const { return !collinear((*this)[t[0]], (*this)[t[1]], (*this)[t[2]]); }

 private:
  Vec3 operator[](Index v) const {
    return Vec3::Map(
        &surface_.positions[3 * static_cast<std::size_t>(file_vertex_of_.empty() ? v : file_vertex_of_[v])]);
  }

  const SurfaceView& surface_;
  std::vector<Index> file_vertex_of_;  // empty: they are the same
};

/// Leaves out triangles with a repeated vertex that are an edge or a corner of one with area.
void leave_out_what_others_cover(const SurfaceView& surface, std::span<const Index> vertex_of, Triangulation& cut) {
  std::vector<Edge> extents;
  for (const Triangle& t : cut.triangles)
    if (uses_a_vertex_twice(t)) extents.push_back(extent_of(t));
  if (extents.empty()) return;
  sort_unique(extents);
  std::vector<std::uint8_t> is_covered(extents.size(), 0);
  const auto place_of = [&](const Edge& extent) {
    const auto place = std::lower_bound(extents.begin(), extents.end(), extent);
    return place != extents.end() && *place == extent ? place - extents.begin() : -1;
  };
  const CornerPositions positions(surface, vertex_of);
  for (const Triangle& t : cut.triangles) {
    if (uses_a_vertex_twice(t)) continue;
    for (int k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];
      for (const Edge& part : {Edge{a, a}, Edge{std::min(a, b), std::max(a, b)}})
        if (const auto place = place_of(part); place >= 0 && positions.has_area(t))
          is_covered[static_cast<std::size_t>(place)] = 1;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cut.triangles.size(); ++i) {
    const Triangle t = cut.triangles[i];
    if (uses_a_vertex_twice(t) && is_covered[static_cast<std::size_t>(place_of(extent_of(t)))] != 0) continue;
    cut.triangles[kept] = t;
    cut.polygon[kept++] = cut.polygon[i];
  }
  cut.statistics.dropped += cut.triangles.size() - kept;
  cut.triangles.resize(kept);
  cut.polygon.resize(kept);
}

}  // namespace

Triangulation triangulate(const SurfaceView& surface, std::span<const Index> vertex_of) {
  const std::size_t count = surface.face_count();
  std::vector<Triangulation> blocks((count + polygons_in_block - 1) / polygons_in_block);
  parallel_for(blocks.size(), [&](std::size_t i) {
    Triangulation& block = blocks[i];
    PolygonCutter cutter(surface, block.statistics);
    const std::size_t end = std::min(count, (i + 1) * polygons_in_block);
    for (std::size_t f = i * polygons_in_block; f < end; ++f)
      cutter.cut(surface.face(f), [&](Index a, Index b, Index c) {
        const Triangle t = vertex_of.empty() ? Triangle{a, b, c} : Triangle{vertex_of[a], vertex_of[b], vertex_of[c]};
        block.triangles.push_back(t);
        block.polygon.push_back(static_cast<Index>(f));
      });
  });

  Triangulation result;
  std::size_t total = 0;
  for (const Triangulation& block : blocks) total += block.triangles.size();
  result.triangles.reserve(total);
  result.polygon.reserve(total);
  for (const Triangulation& block : blocks) {
    result.triangles.insert(result.triangles.end(), block.triangles.begin(), block.triangles.end());
    result.polygon.insert(result.polygon.end(), block.polygon.begin(), block.polygon.end());
    add(result.statistics, block.statistics);
  }
  leave_out_what_others_cover(surface, vertex_of, result);
  return result;
}

Triangulation triangulate_other_diagonals(const SurfaceView& surface, std::span<const Index> vertex_of) {
  Triangulation result;
  PolygonCutter cutter(surface, result.statistics);
  for (std::size_t f = 0; f < surface.face_count(); ++f)
    cutter.cut_otherwise(surface.face(f), [&](Index a, Index b, Index c) {
      const Triangle t = vertex_of.empty() ? Triangle{a, b, c} : Triangle{vertex_of[a], vertex_of[b], vertex_of[c]};
      if (uses_a_vertex_twice(t)) return;
      result.triangles.push_back(t);
      result.polygon.push_back(static_cast<Index>(f));
    });
  return result;
}

std::string CutStatistics::describe() const {
  std::string text;
  const auto say = [&](std::size_t number, const std::string& of_one, const std::string& of_several) {
    if (number == 0) return;
    if (!text.empty()) text += ", ";
    text += std::to_string(number) + " " + (number == 1 ? of_one : of_several);
  };
  say(triangles, "triangle as it is", "triangles as they are");
  say(quads - quads_other_diagonal, "quad cut from its first corner", "quads cut from their first corner");
  say(quads_other_diagonal, "quad cut from its second corner", "quads cut from their second corner");
  say(clipped, "larger polygon cut ear by ear", "larger polygons cut ear by ear");
  say(forced_ears, "of these ears forced", "of these ears forced");
  say(too_small, "face with fewer than three corners", "faces with fewer than three corners");
  say(dropped, "triangle with a repeated vertex left out", "triangles with a repeated vertex left out");
  return text.empty() ? "no faces" : text;
}

}  // namespace unsnarl
