#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "applications/curves/files/curve_file.h"
#include "applications/curves/files/path_data.h"

namespace unsnarl {

/// One subpath of an element.
struct SvgPiece {
  Subpath path;
  std::optional<std::size_t> curve;  ///< nothing: fewer than two points
};

/// An element of a drawing whose curves may move.
struct SvgShape {
  std::string kind;      ///< name of the element; of a <use> "use"
  std::string style;     ///< of a <use>: the attributes that the path in its place takes from the element that it shows
  std::size_t name = 0;  ///< where its name is in the text
  std::string data;      ///< of a path
  Affine transform;
  std::vector<SvgPiece> pieces;
};

/// A drawing as it was parsed.
class SvgFile final : public CurveFile {
 public:
  std::string patched(std::span<const Curve> moved, double rounding,
                      std::span<const CurveWriting> writing) const override;

  std::unique_ptr<CurveFile> parse_alike(std::string text, double part_of_tolerance) const override {
    return parse_svg(std::move(text), 1, part_of_tolerance * flatten);
  }

  std::vector<SvgShape> shapes;
  double flatten = 0;  ///< largest distance of a polyline from the curve that it replaces
};

}  // namespace unsnarl
