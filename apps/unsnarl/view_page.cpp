#include "view_page.h"

#include <algorithm>
#include <filesystem>

#include "contact/intersection_finder.h"
#include "contact/intersection_segments.h"
#include "mesh_input.h"
#include "render/page.h"
#include "scene/prepared_surface.h"
#include "usage_error.h"
#include "viewer_template.h"

namespace unsnarl::app {

std::string page_name(const std::string& path) {
  return path == standard_stream ? "mesh" : std::filesystem::path(path).filename().string();
}

void require_viewer() {
  if (viewer_template().empty())
    throw UsageError(
        "this build has no viewer: it was made without Node.js or without the viewer's packages. Install nodejs and "
        "npm, run 'npm ci' in viewer/, then configure and build again with -DUNSNARL_BUILD_VIEWER=ON (./demo does it "
        "all)");
}

std::string view_page(const PageSource& source) {
  require_viewer();
  const PreparedSurface prepared = prepare(source.before, source.find);
  IntersectionFinder finder(prepared.triangles());
  std::vector<IntersectingPair> pairs_before, pairs_after;
  const auto state_at = [&](std::span<const double> positions, std::vector<IntersectingPair>& pairs) {
    const Positions x = prepared.gather(positions);
    std::vector<IntersectingPair> of_triangles = finder.find(x);
    if (source.goal == Goal::disjoint)
      std::erase_if(of_triangles, [](const IntersectingPair& pair) { return pair.kind != PairClass::disjoint; });
    pairs = pairs_of_faces(prepared.triangulation.polygon, of_triangles);
    return PageState{positions, pairs, intersection_segments(x, prepared.triangles(), of_triangles)};
  };
  PageContent content;
  content.input_name = source.input_name;
  content.output_name = source.output_name;
  content.faces = source.before;
  content.before = state_at(source.before.positions, pairs_before);
  if (!source.after.empty()) content.after = state_at(source.after, pairs_after);
  content.report = source.report;
  content.frames = source.frames;
  return make_page(viewer_template(), content);
}

}  // namespace unsnarl::app
