#include <nlohmann/json.hpp>

#include "arguments.h"
#include "results.h"
#include "unsnarl/page.h"

namespace unsnarl::c_interface {
namespace {

/// Meshes that lie one after another, or a file, which says which way is up.
std::vector<SceneFile> files_of(const unsnarl_surface& surface, const std::string& name) {
  std::vector<SceneFile> files = meshes_of(surface);
  if (files.empty() && surface.document) {
    const SurfaceView view = view_of(surface);
    files.push_back({name, 0, view.vertex_count(), 0, view.face_count(), surface.document->scene->document(0).up()});
  }
  return files;
}

/// The names of the files that are shown.
std::string page_title(const unsnarl_document& document) {
  std::string title;
  for (const SceneFile& file : document.scene->files()) title += (title.empty() ? "" : ", ") + file.name;
  return title;
}

unsnarl_result page(const unsnarl_surface& surface, const unsnarl_page_content& content, const RepairOptions& options) {
  PageSource source;
  source.input_name = content.name ? content.name : surface.document ? page_title(*surface.document) : "mesh";
  if (content.moved_name) source.output_name = content.moved_name;
  source.before = view_of(surface);
  check_corners(source.before);
  if (content.moved && content.moved_count != source.before.vertex_count())
    throw std::invalid_argument("moved has " + std::to_string(content.moved_count) + " vertices, the surface " +
                                std::to_string(source.before.vertex_count()));
  if (content.moved) source.after = std::span(content.moved, 3 * content.moved_count);
  const std::vector<SceneFile> files = files_of(surface, source.input_name);
  source.files = files;
  Appearance appearance;
  if (surface.document) {
    appearance = surface.document->scene->appearance();
    source.labels = surface.document->scene->face_labels();
  }
  source.appearance = &appearance;
  source.find = options.find;
  source.goal = options.goal;
  if (content.report) source.report = content.report;

  const std::string html = view_page(built_in_page(), source);
  unsnarl_result result;
  result.arrays["html"] = {std::vector<std::uint8_t>(html.begin(), html.end()), 1};
  // Notes quote the file, whose bytes need not be UTF-8.
  result.report = Json{{"notes", appearance.notes}}.dump(-1, ' ', false, Json::error_handler_t::replace);
  return result;
}

}  // namespace
}  // namespace unsnarl::c_interface

using namespace unsnarl;
using namespace unsnarl::c_interface;

int unsnarl_page(const unsnarl_surface* surface, const unsnarl_page_content* content, const unsnarl_options* options,
                 unsnarl_result** result) {
  return hand_out(result, [&] {
    const unsnarl_surface whole = surface_of(surface);
    return page(whole, content_of(content), frame_options(options_of(options, Work::search), whole));
  });
}
