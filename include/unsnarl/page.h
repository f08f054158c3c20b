#pragma once

#include <span>
#include <string>
#include <string_view>

#include "unsnarl/appearance.h"
#include "unsnarl/document.h"
#include "unsnarl/intersections.h"
#include "unsnarl/recording.h"
#include "unsnarl/repair.h"
#include "unsnarl/scene_document.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// The contents of the page of `unsnarl view`. Everything it views must outlive the call of view_page.
struct PageSource {
  std::string input_name, output_name;  ///< for the reader; any bytes. output_name may be empty
  SurfaceView before;
  std::span<const double> after = {};       ///< 3 a vertex of `before`; empty: there is only one surface to look at
  std::span<const SceneFile> files = {};    ///< of `before`; of several, each has a colour of its own. May be empty
  std::span<const FaceLabels> labels = {};  ///< of the faces, SceneDocument::face_labels; may be empty
  const Appearance* appearance = nullptr;   ///< SceneDocument::appearance, to be looked at too; null: none
  FindOptions find;                         ///< welding
  Goal goal = Goal::all;                    ///< which pairs are shown
  std::string report;                       ///< as of report_json; empty: none
  std::span<const RecordedFrame> frames;    ///< RepairResult::frames; may be empty
};

/// The page that viewer/ builds, without data.
std::string_view built_in_page();

/// One HTML file that shows it all, and needs no network: the template with the mesh, its intersections and its
/// displacements in it. Positions are drawn in 32 bits; displacements are computed in 64.
///
/// page_template: HTML with a place for data: built_in_page().
/// Throws std::invalid_argument where the template has no such place, the report is no JSON, or the surface makes no
/// sense (as find_intersections does).
std::string view_page(std::string_view page_template, const PageSource& source);

}  // namespace unsnarl
