#include "mesh/triangulation.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "mesh/ear_clipper.h"

namespace unsnarl {
namespace {

/// Polygons cut by one task; the tasks do not depend on the number of threads.
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
      find_mean_normal(corners);
      if (corners.size() == 4)
        cut_quad(corners[0], corners[1], corners[2], corners[3], emit);
      else
        clip_ears(corners, emit);
    }
  }

  /// The same for the other diagonal of a quad, if neither folds.
  template <class Emit>
  void cut_otherwise(std::span<const Index> corners, Emit&& emit) {
    if (corners.size() != 4) return;
    const Index a = corners[0], b = corners[1], c = corners[2], d = corners[3];
    find_mean_normal(corners);
    if (std::min({side(a, b, c), side(a, c, d), side(b, c, d), side(b, d, a)}) <= 0) return;
    emit(b, c, d);
    emit(b, d, a);
  }

 private:
  Vec3 position(Index v) const {
    const double* p = &surface_.positions[3 * static_cast<std::size_t>(v)];
    return {p[0], p[1], p[2]};
  }

  void find_mean_normal(std::span<const Index> corners) {
    const Vec3 origin = position(corners[0]);
    normal_ = Vec3::Zero();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 a = position(corners[k]) - origin, b = position(corners[(k + 1) % corners.size()]) - origin;
      normal_ += a.cross(b);
    }
  }

  /// Positive where a, b, c turn left as seen against the mean normal.
  double side(Index a, Index b, Index c) const { return turn(normal_, position(a), position(b), position(c)); }

  template <class Emit>
  void cut_quad(Index a, Index b, Index c, Index d, Emit&& emit) {
    ++statistics_.quads;
    const bool first_is_flat = std::min(side(a, b, c), side(a, c, d)) > 0;
    if (first_is_flat || std::min(side(b, c, d), side(b, d, a)) <= 0) {
      emit(a, b, c);
      emit(a, c, d);
    } else {
      ++statistics_.quads_other_diagonal;
      emit(b, c, d);
      emit(b, d, a);
    }
  }

  template <class Emit>
  void clip_ears(std::span<const Index> corners, Emit&& emit) {
    ++statistics_.clipped;
    points_.clear();
    for (Index corner : corners) points_.push_back(position(corner));
    triangles_.clear();
    statistics_.forced_ears += clipper_.clip(corners, points_, normal_, triangles_);
    for (const auto& [a, b, c] : triangles_) emit(corners[a], corners[b], corners[c]);
  }

  const SurfaceView& surface_;
  CutStatistics& statistics_;
  Vec3 normal_;
  EarClipper clipper_;
  std::vector<Vec3> points_;         // of one polygon's corners
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

}  // namespace

Triangulation triangulate(const SurfaceView& surface, std::span<const Index> vertex_of) {
  const std::size_t count = surface.face_count();
  std::vector<Triangulation> blocks((count + polygons_in_block - 1) / polygons_in_block);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
    Triangulation& block = blocks[i];
    PolygonCutter cutter(surface, block.statistics);
    const std::size_t end = std::min(count, (i + 1) * polygons_in_block);
    for (std::size_t f = i * polygons_in_block; f < end; ++f)
      cutter.cut(surface.face(f), [&](Index a, Index b, Index c) {
        const Triangle t = vertex_of.empty() ? Triangle{a, b, c} : Triangle{vertex_of[a], vertex_of[b], vertex_of[c]};
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
          ++block.statistics.dropped;
          return;
        }
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
  return result;
}

Triangulation triangulate_other_diagonals(const SurfaceView& surface, std::span<const Index> vertex_of) {
  Triangulation result;
  PolygonCutter cutter(surface, result.statistics);
  for (std::size_t f = 0; f < surface.face_count(); ++f)
    cutter.cut_otherwise(surface.face(f), [&](Index a, Index b, Index c) {
      const Triangle t = vertex_of.empty() ? Triangle{a, b, c} : Triangle{vertex_of[a], vertex_of[b], vertex_of[c]};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
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
