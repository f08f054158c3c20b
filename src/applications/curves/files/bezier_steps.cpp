#include "applications/curves/files/bezier_steps.h"

#include <cmath>
#include <numbers>

#include "applications/curves/files/fit_beziers.h"
#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

/// Pieces of an arc are merged into Bézier curves that turn by no more than this, less than 2e-7 of its radius from it;
/// a single piece may turn farther (unit: radians)
constexpr double most_turn = std::numbers::pi / 8;

constexpr int not_drawn = -1;  ///< In place of a curve's number: the drawing has no such piece (no unit)

Vec2 point_of(const Curve& curve, std::size_t k) {
  k %= curve.size();
  return {curve.points[2 * k], curve.points[2 * k + 1]};
}

DrawnPiece backwards(const DrawnPiece& piece) {
  return {piece.command, piece.end, piece.begin, -piece.to, -piece.from, piece.turn};
}

bool is_forward(const DrawnPiece& piece) {
  return piece.end > piece.begin;
}

double turn_of(const DrawnPiece& piece) {
  return piece.turn * std::abs(piece.end - piece.begin);
}

/// The length of the handles of a Bézier curve over a part of a curve / the derivative of that curve.
double handle_of(const DrawnPiece& piece) {
  const double range = std::abs(piece.end - piece.begin), turn = turn_of(piece);
  return turn > 0 ? range * 4 / 3 * portable::tan(turn / 4) / turn : range / 3;
}

}  // namespace

void DrawnPieces::add(const Curve& flattened, std::span<const DrawnPiece> pieces) {
  const std::size_t count = flattened.closed ? flattened.size() : flattened.size() - 1;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2 a = point_of(flattened, k), b = point_of(flattened, k + 1);
    places_[{a.x(), a.y(), b.x(), b.y()}].push_back({curves_, pieces[k]});
    places_[{b.x(), b.y(), a.x(), a.y()}].push_back({curves_, backwards(pieces[k])});
  }
  ++curves_;
}

/// The piece from each point to the next, and the curve that it is of. Of several between the same points it is the one
/// that goes on where the piece before it ends.
std::vector<DrawnPiece> DrawnPieces::pieces_of(const Curve& curve, std::vector<int>& curve_of) const {
  const std::size_t count = curve.closed ? curve.size() : curve.size() - 1;
  std::vector<DrawnPiece> pieces(count);
  curve_of.assign(count, not_drawn);
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2 a = point_of(curve, k), b = point_of(curve, k + 1);
    const auto found = places_.find({a.x(), a.y(), b.x(), b.y()});
    if (found == places_.end()) continue;
    const Place* best = &found->second.front();
    for (const Place& place : found->second)
      if (k > 0 && place.curve == curve_of[k - 1] && place.piece.command == pieces[k - 1].command &&
          place.piece.begin == pieces[k - 1].end && is_forward(place.piece) == is_forward(pieces[k - 1]))
        best = &place;
    pieces[k] = best->piece;
    curve_of[k] = best->curve;
  }
  return pieces;
}

std::vector<PathStep> DrawnPieces::along(const Curve& curve, bool smooth, double tolerance,
                                         const std::function<bool(std::size_t)>& is_stop) const {
  std::vector<int> curve_of;
  const std::vector<DrawnPiece> pieces = pieces_of(curve, curve_of);
  const std::size_t count = pieces.size();
  const auto is_drawn = [&](std::size_t k) { return curve_of[k] != not_drawn; };
  const auto is_curved = [&](std::size_t k) { return is_drawn(k) && pieces[k].command >= 0; };
  const auto before = [&](std::size_t k) { return (k + count - 1) % count; };

  // Which segments that are not the drawing's have curves on both sides of their run, around the end of a closed curve.
  std::vector<std::uint8_t> is_smooth(count, smooth ? 1 : 0);
  for (const bool from_end : {false, true}) {
    bool is_behind_curve = false;
    for (std::size_t i = 0; i < (curve.closed ? 2 * count : count); ++i) {
      const std::size_t k = from_end ? count - 1 - i % count : i % count;
      if (is_drawn(k)) is_behind_curve = is_curved(k);
      const bool is_seen_whole = !curve.closed || i >= count;
      if (is_seen_whole && !is_behind_curve) is_smooth[k] = 0;
    }
  }
  // The direction at a point where two runs of segments meet.
  const auto direction_at = [&](std::size_t k) -> Vec2 {
    if (is_curved(before(k))) return pieces[before(k)].to;
    if (is_curved(k % count)) return pieces[k % count].from;
    const Vec2 a = point_of(curve, before(k)), b = point_of(curve, k), c = point_of(curve, k + 1);
    return (b - a).normalized() + (c - b).normalized();
  };

  std::vector<PathStep> steps;
  for (std::size_t k = 0, end = 1; k < count; k = end, ++end) {
    if (is_curved(k)) {
      DrawnPiece whole = pieces[k];
      const auto goes_on = [&](std::size_t next) {
        return next < count && !is_stop(next) && curve_of[next] == curve_of[k] &&
               pieces[next].command == whole.command && pieces[next].begin == whole.end &&
               is_forward(pieces[next]) == is_forward(whole) &&
               whole.turn * std::abs(pieces[next].end - whole.begin) <= most_turn;
      };
      for (; goes_on(end); ++end) {
        whole.end = pieces[end].end;
        whole.to = pieces[end].to;
      }
      const double handle = handle_of(whole);
      steps.push_back({end % curve.size(), std::array<Vec2, 2>{point_of(curve, k) + handle * whole.from,
                                                               point_of(curve, end) - handle * whole.to}});
    } else if (!is_drawn(k) && is_smooth[k] != 0) {
      while (end < count && !is_stop(end) && !is_drawn(end)) ++end;
      std::vector<Vec2> points;
      for (std::size_t to = k; to <= end; ++to) points.push_back(point_of(curve, to));
      for (const FittedBezier& bezier : fit_beziers(points, direction_at(k), direction_at(end), tolerance))
        steps.push_back({(k + bezier.to) % curve.size(), bezier.controls});
    } else {
      steps.push_back({end % curve.size(), std::nullopt});
    }
  }
  return steps;
}

}  // namespace unsnarl
