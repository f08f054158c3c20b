#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/curves.h"

namespace unsnarl {

/// A file of curves with its bytes.
class CurveFile {
 public:
  virtual ~CurveFile() = default;
  /// The file with these curves in place of its own. Moved coordinates are rounded to about `rounding`, a length.
  /// writing: one a curve, or empty, as of CurveDocument::patched.
  virtual std::string patched(std::span<const Curve> moved, double rounding,
                              std::span<const CurveWriting> writing) const = 0;
  /// Another text of this kind, curves flattened to within this part of the tolerance here.
  virtual std::unique_ptr<CurveFile> parse_alike(std::string text, double part_of_tolerance) const = 0;

  std::string bytes;
  std::vector<Curve> curves;
  std::vector<std::string> ids;
  std::vector<std::string> notes;
};

/// The fewest digits that give the double back.
std::string digits_of(double value);
/// Rounded to a multiple of a power of ten that is no larger than `rounding`.
double rounded(double value, double rounding);

std::unique_ptr<CurveFile> parse_curve_json(std::string bytes);
/// Béziers and arcs are flattened to within flatten_rel of the drawing's diagonal, or to `flatten` where it is > 0, a
/// length.
std::unique_ptr<CurveFile> parse_svg(std::string bytes, double flatten_rel, double flatten = 0);

}  // namespace unsnarl
