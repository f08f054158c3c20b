#pragma once

#include <limits>
#include <pugixml.hpp>

#include "applications/curves/files/path_data.h"

namespace unsnarl {

/// The rectangle that percentages are of: that of the nearest <svg>, in user units. Infinite: it is not known.
struct Viewport {
  Vec2 low = Vec2::Zero(), size = Vec2::Constant(std::numeric_limits<double>::infinity());
  /// What 100 % of a measure are: 'x' across, 'y' up, any other letter in no direction (SVG 1.1, §7.10).
  double whole(char direction) const;
};

/// A length in user units: px, in, cm, mm, pt, pc, q or none, or per cent of `whole`. Throws FileError for others (em).
double parse_length(std::string_view text, double whole);

/// The `transform` of CSS: the functions of the plane, lengths in pixels or other units, angles in deg, grad, rad and
/// turn; "none" is the identity. Lower case. Throws FileError.
Affine parse_css_transform(std::string_view text, const Viewport& viewport);

/// The transform about an origin: lengths, per cent of the viewport, or left, center, right, top, bottom. Throws
/// FileError.
Affine about_origin(const Affine& transform, std::string_view origin, const Viewport& viewport);

/// The viewport of an <svg> element: its viewBox, or its width and height, of which those of an inner one are all of
/// the outer one's where it says nothing. Throws FileError.
Viewport viewport_of(const pugi::xml_node& svg, const Viewport& outer);

/// How an inner <svg> is placed: x, y, viewBox and preserveAspectRatio (SVG 1.1, §7.8). Throws FileError.
Affine placing_of(const pugi::xml_node& svg, const Viewport& outer);

}  // namespace unsnarl
