#include "render/page.h"

#include <stdexcept>

#include "geometry/box.h"
#include "geometry/scale.h"
#include "mesh/triangulation.h"
#include "render/camera.h"
#include "render/page_appearance.h"
#include "render/page_elements.h"
#include "unsnarl/version.h"

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

/// Version of the data of a page, raised when older pages can no longer read it; page and data are written together
/// (fixed by the page)
constexpr int page_schema_version = 1;
constexpr std::string_view place_for_data = "<!--unsnarl-data-->";

/// From the units of the file to those of the page.
class PageUnits {
 public:
  explicit PageUnits(std::span<const double> positions) : scale_(positions) {
    Box box;
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3) box.extend(scaled(positions, i));
    if (!positions.empty()) {
      centre_ = box.center();
      diagonal_ = box.diagonal();
    }
  }
  // Of the file.
  Vec3 centre() const {
    return centre_.unaryExpr([&](double x) { return scale_.out(x); });
  }
  double diagonal() const { return scale_.out(diagonal_); }

  float length(double of_file) const { return static_cast<float>(scale_.in(of_file) / unit()); }
  void append(const Vec3& p, std::vector<float>& to) const { append_scaled(scaled({p.data(), 3}, 0), to); }
  /// The lengths of the motions between positions.
  std::vector<float> distances(std::span<const double> before, std::span<const double> after) const {
    std::vector<float> result;
    for (std::size_t i = 0; i + 2 < before.size(); i += 3)
      result.push_back(static_cast<float>((scaled(after, i) - scaled(before, i)).norm() / unit()));
    return result;
  }
  std::vector<float> of(std::span<const double> positions) const {
    std::vector<float> result;
    result.reserve(positions.size());
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3) append_scaled(scaled(positions, i), result);
    return result;
  }

 private:
  double unit() const { return diagonal_ > 0 ? diagonal_ : 1; }
  Vec3 scaled(std::span<const double> positions, std::size_t i) const {
    return {scale_.in(positions[i]), scale_.in(positions[i + 1]), scale_.in(positions[i + 2])};
  }
  void append_scaled(const Vec3& p, std::vector<float>& to) const {
    const Vec3 q = (p - centre_) / unit();
    for (int k = 0; k < 3; ++k) to.push_back(static_cast<float>(q[k]));
  }

  Scale scale_;  // of the centre and the diagonal
  Vec3 centre_ = Vec3::Zero();
  double diagonal_ = 0;
};

Json as_json(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

PageTriangles add_faces(const SurfaceView& surface, PageElements& elements) {
  std::vector<Index> corners(surface.corners.begin(), surface.corners.end());
  if (surface.offsets.empty()) {
    elements.add_words("corners", corners, 3);
    return {std::move(corners), {}};
  }
  std::vector<Index> sizes;
  for (std::size_t f = 0; f < surface.face_count(); ++f) sizes.push_back(static_cast<Index>(surface.face(f).size()));
  elements.add_words("corners", corners, sizes.empty() ? 3 : static_cast<std::size_t>(sizes[0]));
  elements.add_words("sizes", sizes, 1);
  Triangulation cut = triangulate(surface);
  std::vector<Index> triangles;
  for (const Triangle& t : cut.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
  elements.add_words("triangles", triangles, 6);
  elements.add_words("triangle_faces", cut.polygon, 1);
  return {std::move(triangles), std::move(cut.polygon)};
}

void add_conflicts(const std::string& suffix, const PageState& state, const PageUnits& units, PageElements& elements) {
  std::vector<Index> pairs;
  for (const IntersectingPair& pair : state.pairs)
    pairs.insert(pairs.end(), {pair.a, pair.b, static_cast<Index>(pair.kind)});
  elements.add_words("pairs_" + suffix, pairs, 3);
  std::vector<float> curves;
  for (const auto& segment : state.curves)
    for (const Vec3& end : segment) units.append(end, curves);
  elements.add_words("curves_" + suffix, curves, 3);
}

/// The lists of all frames end to end; what is said of each, and how much of the lists is its own, comes as JSON.
Json add_frames(std::span<const RecordedFrame> frames, const PageUnits& units, PageElements& elements) {
  Json described = Json::array();
  std::vector<Index> vertices, faces;
  std::vector<float> displacements;
  for (const RecordedFrame& frame : frames) {
    described.push_back({{"phase", frame.phase},
                         {"strategy", frame.strategy},
                         {"iteration", frame.iteration},
                         {"pairs", frame.pairs},
                         {"allowed", frame.allowed},
                         {"moved", frame.vertices.size()},
                         {"faces", frame.intersecting.size()}});
    vertices.insert(vertices.end(), frame.vertices.begin(), frame.vertices.end());
    faces.insert(faces.end(), frame.intersecting.begin(), frame.intersecting.end());
    for (const double d : frame.displacements) displacements.push_back(units.length(d));
  }
  elements.add_words("frame_vertices", vertices, 1);
  elements.add_words("frame_displacements", displacements, 3);
  elements.add_words("frame_faces", faces, 1);
  return described;
}

/// The list part_faces_K holds the parts of kind K by face: places in its names, or numbers where it has none; -1:
/// none.
Json add_parts(std::span<const FaceLabels> parts, PageElements& elements) {
  Json described = Json::array();
  for (const FaceLabels& labels : parts) {
    elements.add_words("part_faces_" + std::to_string(described.size()), labels.of_face, 1);
    described.push_back({{"kind", labels.kind}, {"names", labels.names}});
  }
  return described;
}

Json described(std::span<const SceneFile> files) {
  Json list = Json::array();
  for (const SceneFile& file : files)
    list.push_back({{"name", file.name},
                    {"first_vertex", file.first_vertex},
                    {"vertices", file.vertices},
                    {"first_face", file.first_face},
                    {"faces", file.faces}});
  return list;
}

}  // namespace

std::string make_page(std::string_view page_template, const PageContent& content) {
  const std::size_t place = page_template.find(place_for_data);
  if (place == std::string_view::npos) throw std::invalid_argument("the template of the page has no place for data");
  const SurfaceView& surface = content.faces;
  const PageUnits units(content.before.positions);
  const Camera camera = three_quarter_view(content.before.positions, 1, 0.1, up_of(content.files));

  PageElements elements;
  const Json frames = add_frames(content.frames, units, elements);
  const Json parts = add_parts(content.parts, elements);
  const PageTriangles triangles = add_faces(surface, elements);
  const Json appearance =
      content.appearance ? add_appearance(*content.appearance, surface, triangles, elements) : Json();
  elements.add_json("scene", {{"schema", "unsnarl-page"},
                              {"schema_version", page_schema_version},
                              {"version", version},
                              {"input", content.input_name},
                              {"output", content.output_name},
                              {"files", described(content.files)},
                              {"parts", parts},
                              {"vertices", surface.vertex_count()},
                              {"faces", surface.face_count()},
                              {"centre", as_json(units.centre())},
                              {"diagonal", units.diagonal()},
                              {"camera", {{"toward", as_json(camera.toward)}, {"up", as_json(camera.up)}}},
                              {"pair_classes", pair_class_names},
                              {"allowed",
                               {{"before", content.before.allowed},
                                {"after", content.after ? content.after->allowed : content.before.allowed}}},
                              {"appearance", appearance},
                              {"report", content.report},
                              {"frames", frames}});
  const std::vector<float> before = units.of(content.before.positions);
  elements.add_words("positions_before", before, 3);
  add_conflicts("before", content.before, units, elements);
  if (content.after) {
    elements.add_words_like("positions_after", units.of(content.after->positions), "positions_before", before);
    elements.add_words("displacement", units.distances(content.before.positions, content.after->positions), 1);
    add_conflicts("after", *content.after, units, elements);
  }
  std::string page;
  page.reserve(page_template.size() + elements.html().size());
  page += page_template.substr(0, place);
  page += elements.html();
  page += page_template.substr(place + place_for_data.size());
  return page;
}

}  // namespace unsnarl
