#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <pugixml.hpp>

#include "applications/curves/files/start_tags.h"
#include "applications/curves/files/style_sheet.h"
#include "applications/curves/files/svg_file.h"
#include "applications/curves/files/viewport.h"
#include "io/xml_text.h"
#include "unsnarl/depth_limit.h"

namespace unsnarl {
namespace {

constexpr double least_scale = 1e-300;  ///< Divisors are kept above this, so that none is zero (fixed by float64)
/// Subpaths are closed over a gap of at most this: relative commands do not come back exactly, and thousands of them
/// add up as many roundings (unit: largest coordinate of the subpath)
constexpr double closing_gap = 1e-12;

std::size_t line_of(std::string_view text, std::size_t offset) {
  return 1 +
         static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

/// Leaves out points that repeat the point before them, with the pieces that lead to them. Then there are as many
/// pieces as points.
void leave_out_repeated_points(Subpath& path) {
  path.pieces.resize(path.points.size());
  std::size_t kept = 0;
  for (std::size_t k = 1; k < path.points.size(); ++k) {
    if (path.points[k] != path.points[kept]) path.points[++kept] = path.points[k];
    path.pieces[kept] = path.pieces[k];
  }
  path.points.resize(std::min(path.points.size(), kept + 1));
  path.pieces.resize(path.points.size());
}

class SvgParser {
 public:
  SvgParser(SvgFile& file, double flatten_rel) : file_(file), flatten_rel_(flatten_rel) {}

  void parse(double flatten) {
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_buffer(file_.bytes.data(), file_.bytes.size(),
                             pugi::parse_default | pugi::parse_declaration | pugi::parse_doctype, pugi::encoding_utf8);
    if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
    if (!result)
      throw FileError(fmt::format("line {}: this is not well-formed XML: {}",
                                  line_of(file_.bytes, std::min<std::size_t>(result.offset, file_.bytes.size())),
                                  result.description()));
    if (const std::optional<std::size_t> place = too_deep_element(document))
      throw FileError(fmt::format("line {}: nested too deeply: more than {} elements within each other",
                                  line_of(file_.bytes, std::min(*place, file_.bytes.size())), deepest_nesting));
    const pugi::xml_node root = document.document_element();
    if (local_name(root) != "svg")
      throw FileError(fmt::format("the root element is <{}>; an SVG file has <svg>", root.name()));
    std::vector<std::string> unknown;
    read_styles(root, unknown);
    if (flatten <= 0) {
      // Twice: the diagonal, on which the tolerance depends, is that of the curves themselves.
      flatten_ = std::numeric_limits<double>::infinity();
      visit(root, {}, {}, true);
      flatten = flatten_rel_ * diagonal_of(file_.curves);
      file_.curves.clear();
      file_.ids.clear();
      file_.notes.clear();
      file_.shapes.clear();
      skipped_.clear();
    }
    file_.flatten = flatten_ = flatten > 0 ? flatten : flatten_rel_;
    visit(root, {}, {}, true);
    for (const auto& [name, count] : skipped_)
      file_.notes.push_back(fmt::format("{} <{}> {} left as {}", count, name,
                                        count == 1 ? "element is" : "elements are", count == 1 ? "it is" : "they are"));
    for (const std::string& what : unknown)
      file_.notes.push_back(fmt::format("the style rule '{}' is not understood; it is ignored", what));
  }

 private:
  void read_styles(const pugi::xml_node& node, std::vector<std::string>& unknown) {
    if (local_name(node) == "style") {
      const std::string_view type = node.attribute("type").value();
      std::string text;
      for (const pugi::xml_node& child : node.children()) text += child.value();
      if (type.empty() || type == "text/css") styles_.add(text, unknown);
      return;
    }
    for (const pugi::xml_node& child : node.children())
      if (child.type() == pugi::node_element) {
        read_styles(child, unknown);
        if (const std::string_view id = child.attribute("id").value(); !id.empty())
          by_id_.emplace(std::string(id), child);
      }
  }

  std::string place_of(const pugi::xml_node& node) const {
    const std::string_view id = node.attribute("id").value();
    const std::size_t line = line_of(file_.bytes, static_cast<std::size_t>(node.offset_debug()));
    return id.empty() ? fmt::format("<{}> on line {}", node.name(), line)
                      : fmt::format("<{}> '{}' on line {}", node.name(), id, line);
  }

  /// The properties that elements take from those around them.
  struct Surroundings {
    Affine transform;
    Viewport viewport;
    bool is_visible = true;
  };

  /// Reads an element and what is in it; leaves one that is not understood as it is, and notes it.
  void visit(const pugi::xml_node& node, const Affine& outer, const Viewport& viewport, bool is_root) {
    visit(node, Surroundings{outer, viewport, true}, is_root);
  }
  void visit(const pugi::xml_node& node, const Surroundings& around, bool is_root) {
    const std::string_view name = local_name(node);
    for (const char* const aside : {"defs", "symbol", "clipPath", "mask", "marker", "pattern", "linearGradient",
                                    "radialGradient", "filter", "metadata", "style", "script", "title", "desc"})
      if (name == aside) return;
    if (styles_.declared(node, "display") == "none") return;
    for (const char* const other : {"text", "image", "foreignObject"})
      if (name == other) {
        ++skipped_[other];
        return;
      }
    try {
      const Surroundings within = surroundings_within(node, around, is_root);
      if (name == "use") {
        add_use(node, within);
      } else if (is_shape(name)) {  // shapes within it are not drawn
        if (is_background(node)) {
          ++skipped_[fmt::format("{} in %", name)];
        } else if (within.is_visible) {
          add_shape(node, node, std::string(name), within, {});
        }
      } else {
        for (const pugi::xml_node& child : node.children())
          if (child.type() == pugi::node_element) visit(child, within, false);
      }
    } catch (const FileError& e) {
      file_.notes.push_back(fmt::format("{} is left as it is: {}", place_of(node), e.what()));
    }
  }

  Surroundings surroundings_within(const pugi::xml_node& node, const Surroundings& around, bool is_root) const {
    Surroundings within = around;
    if (const std::string visibility = styles_.declared(node, "visibility"); !visibility.empty())
      within.is_visible = visibility == "visible" || (visibility == "inherit" && around.is_visible);
    within.transform = around.transform * transform_of(node, around.viewport);
    if (local_name(node) == "svg") {
      if (is_root) {
        try {
          within.viewport = viewport_of(node, around.viewport);
        } catch (const FileError&) {  // only percentages need it
        }
      } else {
        within.transform = within.transform * placing_of(node, around.viewport);
        within.viewport = viewport_of(node, around.viewport);
      }
    }
    return within;
  }

  /// The property of CSS, which overrides the attribute, about its origin.
  Affine transform_of(const pugi::xml_node& node, const Viewport& viewport) const {
    for (const char* const single : {"translate", "rotate", "scale", "offset-path"})
      if (const std::string value = styles_.declared_in_css(node, single); !value.empty() && value != "none")
        throw FileError(fmt::format("the property '{}' of CSS is not supported; use 'transform'", single));
    const std::string in_css = styles_.declared_in_css(node, "transform");
    Affine transform;
    if (!in_css.empty()) {
      transform = parse_css_transform(in_css, viewport);
    } else if (node.attribute("transform")) {
      transform = parse_transform(node.attribute("transform").value());
    }
    const std::string origin = styles_.declared(node, "transform-origin");
    if (origin.empty() || transform.is_identity()) return transform;
    const std::string box = styles_.declared(node, "transform-box");
    if (!box.empty() && box != "view-box") throw FileError(fmt::format("transform-box: {} is not supported", box));
    return about_origin(transform, origin, viewport);
  }

  /// The page itself.
  static bool is_background(const pugi::xml_node& node) {
    return local_name(node) == "rect" && std::string_view(node.attribute("width").value()) == "100%" &&
           std::string_view(node.attribute("height").value()) == "100%";
  }

  /// A <use> of a shape is that shape in another place; when it moves, a group with a path takes its place.
  void add_use(const pugi::xml_node& node, const Surroundings& within) {
    std::string_view target = node.attribute("href").value();
    if (target.empty()) target = node.attribute("xlink:href").value();
    const auto found = target.starts_with('#') ? by_id_.find(target.substr(1)) : by_id_.end();
    if (found == by_id_.end() || !is_shape(local_name(found->second))) {
      ++skipped_["use"];
      return;
    }
    const pugi::xml_node& shown = found->second;
    if (styles_.declared(shown, "display") == "none") return;
    Surroundings place = surroundings_within(shown, {Affine(), within.viewport, within.is_visible}, false);
    if (!place.is_visible) return;
    Affine moved;
    moved.offset = {length(node, "x", within.viewport), length(node, "y", within.viewport)};
    const Affine inner = moved * place.transform;
    place.transform = within.transform;
    add_shape(node, shown, "use", place, inner);
  }

  static bool is_shape(std::string_view name) {
    for (const char* const shape : {"path", "polyline", "polygon", "line", "rect", "circle", "ellipse"})
      if (name == shape) return true;
    return false;
  }

  static double length(const pugi::xml_node& node, const char* name, const Viewport& viewport) {
    const std::string_view text = node.attribute(name).value(), key = name;
    if (text.empty() || text == "auto") return 0;
    const bool across = key.starts_with('x') || key == "cx" || key == "width" || key == "rx";
    const bool up = key.starts_with('y') || key == "cy" || key == "height" || key == "ry";
    try {
      return parse_length(text, viewport.whole(across ? 'x' : up ? 'y' : 'r'));
    } catch (const FileError& e) {
      throw FileError(fmt::format("{}=\"{}\": {}", name, text, e.what()));
    }
  }

  /// The drawing of the element `shown`, at `node`: itself, or a <use> of it, in whose coordinates `inner` puts it.
  void add_shape(const pugi::xml_node& node, const pugi::xml_node& shown, const std::string& kind,
                 const Surroundings& place, const Affine& inner) {
    for (const char* const measure : measures)
      if (!styles_.declared_in_css(shown, measure).empty())
        throw FileError(fmt::format("'{}' in CSS is not supported; use the attribute", measure));
    const Affine whole = place.transform * inner;
    if (!whole.is_invertible())
      throw FileError("its transforms flatten the plane, so its coordinates cannot be computed");
    SvgShape shape{.kind = kind,
                   .style = {},
                   .name = static_cast<std::size_t>(node.offset_debug()),
                   .data = {},
                   .transform = place.transform,
                   .pieces = {}};
    const double tolerance = flatten_ / std::max(whole.scale(), least_scale);
    const std::string_view drawn = local_name(shown);
    std::vector<Subpath> paths;
    if (drawn == "path") {
      shape.data = shown.attribute("d").value();
      paths = parse_path_data(shape.data, tolerance);
    } else if (drawn == "polyline" || drawn == "polygon") {
      const std::vector<double> numbers = parse_number_list(shown.attribute("points").value());
      if (numbers.size() % 2 != 0)
        throw FileError(fmt::format("points holds {} numbers; give x and y of each point", numbers.size()));
      Subpath path;
      for (std::size_t k = 0; k < numbers.size(); k += 2) path.points.emplace_back(numbers[k], numbers[k + 1]);
      path.closed = drawn == "polygon";
      paths.push_back(std::move(path));
    } else {
      // By the path that SVG says they are (SVG 1.1, §9).
      const std::string data = data_of_shape(shown, drawn, place.viewport);
      if (!data.empty()) paths = parse_path_data(data, tolerance);
    }
    for (Subpath& path : paths) {
      for (Vec2& p : path.points) p = inner(p);
      for (DrawnPiece& piece : path.pieces) piece = transformed(piece, inner);
      path.start = inner(path.start);
    }
    if (kind == "use") shape.style = attributes_besides_geometry(shown);
    for (Subpath& path : paths) add_piece(node, std::move(path), paths.size() > 1, shape);
    file_.shapes.push_back(std::move(shape));
  }

  /// The attributes of a shape that say nothing of where it is, as they are in the text.
  std::string attributes_besides_geometry(const pugi::xml_node& shape) const {
    std::string result;
    for (const auto& [key, attribute] : attributes_of(file_.bytes, static_cast<std::size_t>(shape.offset_debug()))) {
      const bool is_place = key == "id" || key == "d" || key == "points" || key == "transform" ||
                            std::find(measures.begin(), measures.end(), key) != measures.end();
      if (!is_place) result += ' ' + file_.bytes.substr(attribute.begin, attribute.end - attribute.begin);
    }
    return result;
  }

  static std::string data_of_shape(const pugi::xml_node& node, std::string_view kind, const Viewport& viewport) {
    const auto get = [&](const char* name) { return length(node, name, viewport); };
    if (kind == "line") return fmt::format("M{} {}L{} {}", get("x1"), get("y1"), get("x2"), get("y2"));
    if (kind == "rect") {
      const double x = get("x"), y = get("y"), w = get("width"), h = get("height");
      if (w <= 0 || h <= 0) return {};
      double rx = get("rx"), ry = get("ry");
      if (!node.attribute("rx")) rx = ry;
      if (!node.attribute("ry")) ry = rx;
      rx = std::min(rx, w / 2);
      ry = std::min(ry, h / 2);
      if (rx <= 0 || ry <= 0) return fmt::format("M{} {}H{}V{}H{}Z", x, y, x + w, y + h, x);
      const std::string arc = fmt::format("A{} {} 0 0 1 ", rx, ry);
      const auto to = [&](double px, double py) { return fmt::format("{}{} {}", arc, px, py); };
      return fmt::format("M{} {}L{} {}{}L{} {}{}L{} {}{}L{} {}{}Z", x + rx, y, x + w - rx, y, to(x + w, y + ry), x + w,
                         y + h - ry, to(x + w - rx, y + h), x + rx, y + h, to(x, y + h - ry), x, y + ry, to(x + rx, y));
    }
    const double cx = get("cx"), cy = get("cy");
    double rx = get(kind == "circle" ? "r" : "rx"), ry = get(kind == "circle" ? "r" : "ry");
    if (rx <= 0 || ry <= 0) return {};
    const std::string arc = fmt::format("A{} {} 0 0 1 ", rx, ry);
    return fmt::format("M{} {}{}{} {}{}{} {}Z", cx + rx, cy, arc, cx - rx, cy, arc, cx + rx, cy);
  }

  void add_piece(const pugi::xml_node& node, Subpath path, bool is_one_of_several, SvgShape& shape) {
    SvgPiece piece;
    std::vector<Vec2>& points = path.points;
    leave_out_repeated_points(path);
    double largest = 0;
    for (const Vec2& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    while (path.closed && points.size() > 1 && (points.back() - points.front()).norm() <= closing_gap * largest) {
      points.pop_back();
      path.pieces.pop_back();
    }
    if (points.size() > 1) {
      Curve curve;
      curve.closed = path.closed && points.size() > 2;
      for (const Vec2& p : points) {
        const Vec2 placed = shape.transform(p);
        curve.points.insert(curve.points.end(), {placed.x(), placed.y()});
      }
      curve.tolerance = path.has_curves && std::isfinite(flatten_) ? flatten_ : 0;
      curve.name = place_of(node);
      if (is_one_of_several) curve.name += fmt::format(", subpath {}", shape.pieces.size() + 1);
      piece.curve = file_.curves.size();
      file_.curves.push_back(std::move(curve));
      file_.ids.emplace_back(node.attribute("id").value());
    }
    piece.path = std::move(path);
    shape.pieces.push_back(std::move(piece));
  }

  SvgFile& file_;
  double flatten_rel_, flatten_ = 0;
  StyleSheet styles_;
  std::map<std::string, pugi::xml_node, std::less<>> by_id_;
  std::map<std::string, int> skipped_;
};

}  // namespace

std::unique_ptr<CurveFile> parse_svg(std::string bytes, double flatten_rel, double flatten) {
  auto file = std::make_unique<SvgFile>();
  file->bytes = std::move(bytes);
  SvgParser(*file, flatten_rel).parse(flatten);
  return file;
}

}  // namespace unsnarl
