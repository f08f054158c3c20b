#include "unsnarl/pictures.h"

#include <algorithm>
#include <stdexcept>

#include "arguments.h"
#include "results.h"
#include "unsnarl/certify.h"

namespace unsnarl::c_interface {
namespace {

std::string picture(const SurfaceView& before, std::span<const double> moved, int width, const FindOptions& find) {
  if (width < 128 || width > 8192)
    throw std::invalid_argument("width is " + std::to_string(width) + "; give pixels from 128 to 8192");
  Certifier certifier(before, find);
  const std::vector<IntersectingPair> pairs_before = certifier.find_intersections(before.positions);
  const auto allowed_at = [&](std::span<const double> positions) {
    return certifier.find_allowed_pairs(positions).size();
  };
  PictureOptions options;
  options.width = width;
  if (moved.empty()) {
    options.height = width * 3 / 4;
    options.before_label = picture_label("mesh", pairs_before.size(), allowed_at(before.positions));
    return picture_png(before, intersecting_faces(pairs_before), options);
  }
  if (moved.size() != before.positions.size())
    throw std::invalid_argument("moved has " + std::to_string(moved.size() / 3) + " vertices, the surface " +
                                std::to_string(before.vertex_count()));
  const std::vector<IntersectingPair> pairs_after = certifier.find_intersections(moved);
  options.height = width / 2;
  options.before_label = picture_label("before", pairs_before.size(), allowed_at(before.positions));
  options.after_label = picture_label("after", pairs_after.size(), allowed_at(moved));
  return picture_png(before, intersecting_faces(pairs_before), {moved, before.corners, before.offsets},
                     intersecting_faces(pairs_after), options);
}

}  // namespace
}  // namespace unsnarl::c_interface

using namespace unsnarl;
using namespace unsnarl::c_interface;

int unsnarl_picture(const unsnarl_surface* surface, const double* moved, size_t moved_count, int32_t width,
                    const unsnarl_options* options, unsnarl_result** result) {
  return hand_out(result, [&] {
    const unsnarl_surface given = surface_of(surface);
    const SurfaceView before = view_of(given);
    check_corners(before);
    const std::span<const double> after = moved ? std::span(moved, 3 * moved_count) : std::span<const double>();
    const std::string png = picture(before, after, width, find_options(options_of(options, Work::search), given));
    unsnarl_result drawn;
    drawn.arrays["png"] = {std::vector<std::uint8_t>(png.begin(), png.end()), 1};
    return drawn;
  });
}
