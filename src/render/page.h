#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/appearance.h"
#include "unsnarl/document.h"
#include "unsnarl/intersections.h"
#include "unsnarl/recording.h"
#include "unsnarl/scene_document.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// The surface at one moment.
struct PageState {
  std::span<const double> positions;        ///< 3 a vertex
  std::span<const IntersectingPair> pairs;  ///< of faces
  std::vector<std::array<Vec3, 2>> curves;  ///< segments of the intersection curves
  std::size_t allowed = 0;                  ///< number of pairs that may intersect and do, which are not shown
};

/// The contents of a page. Everything it views must outlive the call of make_page.
struct PageContent {
  std::string input_name, output_name;  ///< for the reader; any bytes. output_name may be empty
  std::span<const SceneFile> files;     ///< that these are of; may be empty
  SurfaceView faces;                    ///< its faces; its positions are `before`'s
  PageState before;
  std::optional<PageState> after;          ///< of the same faces
  std::vector<FaceLabels> parts;           ///< of `faces`, as parts_of_faces returns them; may be empty
  const Appearance* appearance = nullptr;  ///< of `faces`; null: unknown
  nlohmann::ordered_json report;           ///< as of report_json; null: none
  std::span<const RecordedFrame> frames;   ///< the repair on its way; may be empty
};

/// One HTML file that shows it all: the template with the lists of the mesh in it. Positions are drawn in 32 bits,
/// relative to the middle of the input's bounding box and in units of its diagonal; displacements are computed in 64.
///
/// `page_template` is what viewer/ builds. Throws std::invalid_argument where it has no place for data.
std::string make_page(std::string_view page_template, const PageContent& content);

}  // namespace unsnarl
