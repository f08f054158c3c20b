#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "applications/curves/curve_net.h"

namespace unsnarl {

/// x -> linear x + offset.
struct Affine {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Vec2 offset = Vec2::Zero();

  bool is_identity() const { return linear == Eigen::Matrix2d::Identity() && offset == Vec2::Zero(); }
  Vec2 operator()(const Vec2& p) const { return is_identity() ? p : Vec2(linear * p + offset); }
  Affine operator*(const Affine& inner) const { return {linear * inner.linear, linear * inner.offset + offset}; }
  /// How much a length grows, at most.
  double scale() const { return linear.jacobiSvd().singularValues()[0]; }
  /// There is a way back that keeps half of the digits at least.
  bool is_invertible() const {
    if (!linear.allFinite() || !offset.allFinite()) return false;
    const Vec2 scales = linear.jacobiSvd().singularValues();
    constexpr double half_of_digits = 1e-8;  ///< Ratio of scales that costs half of the digits (fixed by float64)
    return scales[1] > half_of_digits * scales[0];
  }
};

/// The way from a point of a flattened subpath to the next one: a segment, or a part of a Bézier curve or an arc.
struct DrawnPiece {
  int command = -1;                             ///< the curve that it is a part of, counted in its path; -1: none
  double begin = 0, end = 1;                    ///< the part's parameters, in [0, 1]
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< derivatives of the curve by its parameter at both ends
  double turn = 0;                              ///< of an arc: the angle in radians that it turns by in all
};

/// The same piece in the coordinates that a transform leads to.
DrawnPiece transformed(DrawnPiece piece, const Affine& transform);

/// One move-to and what follows it.
struct Subpath {
  std::vector<Vec2> points;  ///< flattened, in the coordinates of the element; one point: nothing is drawn
  /// pieces[k] leads from point k to the next, of a closed subpath around its end; an open one has no last piece.
  std::vector<DrawnPiece> pieces;
  bool closed = false;
  bool has_curves = false;
  Vec2 start = Vec2::Zero();
  /// The text behind the move-to; it begins with a command, or with a number that `implicit` belongs to.
  std::size_t begin = 0, end = 0;
  char implicit = 0;  ///< 'L', 'l' or 0
};

/// The data of a path element (SVG 1.1, §8.3), curves flattened so that no point of them is farther than `tolerance`
/// from the polyline, in the coordinates of the element; infinity: into a few pieces, to measure them. Throws
/// FileError: what is wrong and at which character.
std::vector<Subpath> parse_path_data(std::string_view text, double tolerance);

/// The value of a transform attribute: matrix, translate, scale, rotate, skewX, skewY. Throws FileError.
Affine parse_transform(std::string_view text);

/// All numbers of a list with spaces and commas. Throws FileError.
std::vector<double> parse_number_list(std::string_view text);

}  // namespace unsnarl
