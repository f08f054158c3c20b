#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "applications/curves/files/bezier_steps.h"
#include "applications/curves/files/start_tags.h"
#include "applications/curves/files/svg_file.h"
#include "applications/curves/files/written_places.h"
#include "io/text_edits.h"

namespace unsnarl {
namespace {

std::string text_of(const Vec2& point) {
  return fmt::format("{},{}", digits_of(point.x()), digits_of(point.y()));
}

/// For each point of a moved curve the point of the file's that it is still; -1: none.
std::vector<std::ptrdiff_t> own_points(const Curve& own, const Curve& moved) {
  const auto at = [](const Curve& curve, std::size_t k) {
    return std::array<double, 2>{curve.points[2 * k], curve.points[2 * k + 1]};
  };
  std::map<std::array<double, 2>, std::size_t> places;
  for (std::size_t k = 0; k < own.size(); ++k) places.emplace(at(own, k), k);
  std::vector<std::ptrdiff_t> result(moved.size(), -1);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const auto found = places.find(at(moved, k));
    if (moved.size() == own.size() && at(own, k) == at(moved, k))
      result[k] = static_cast<std::ptrdiff_t>(k);
    else if (moved.size() != own.size() && found != places.end())
      result[k] = static_cast<std::ptrdiff_t>(found->second);
  }
  return result;
}

DrawnPieces drawn_pieces(const SvgFile& file) {
  DrawnPieces drawn;
  for (const SvgShape& shape : file.shapes)
    for (const SvgPiece& piece : shape.pieces) {
      if (!piece.curve) continue;
      std::vector<DrawnPiece> placed;
      for (const DrawnPiece& own : piece.path.pieces) placed.push_back(transformed(own, shape.transform));
      drawn.add(file.curves[*piece.curve], placed);
    }
  return drawn;
}

/// Writes moved curves into the text of a drawing.
class SvgPatch {
 public:
  SvgPatch(const SvgFile& file, std::span<const Curve> moved, double rounding, std::span<const CurveWriting> writing)
      : file_(file),
        moved_(moved),
        writing_(writing),
        places_(file.curves, moved, rounding),
        drawn_(drawn_pieces(file)) {}

  std::string operator()() {
    for (const SvgShape& shape : file_.shapes)
      for (const SvgPiece& piece : shape.pieces)
        for (std::size_t k = 0; is_written(shape, piece) && k < moved_[*piece.curve].size(); ++k)
          places_.expect({moved_[*piece.curve].points[2 * k], moved_[*piece.curve].points[2 * k + 1]}, shape.transform);
    for (const SvgShape& shape : file_.shapes) {
      if (std::none_of(shape.pieces.begin(), shape.pieces.end(),
                       [&](const SvgPiece& piece) { return is_moved(piece); }))
        continue;
      const auto attributes = attributes_of(file_.bytes, shape.name);
      if (shape.kind == "path") {
        const Attribute& d = attributes.find("d")->second;
        edits_.push_back({d.value_begin, d.value_end, path_of(shape)});
        continue;
      }
      if (shape.kind == "use") {
        replace_use(shape, path_of(shape), attributes);
        continue;
      }
      const SvgPiece& piece = shape.pieces[0];
      if (shape.kind == "polyline" || shape.kind == "polygon") {
        const Attribute& list = attributes.find("points")->second;
        std::string points;
        for (const Vec2& point : points_of(shape, piece)) points += (points.empty() ? "" : " ") + text_of(point);
        edits_.push_back({list.value_begin, list.value_end, points});
        continue;
      }
      become_path(shape, piece, attributes);
    }
    return with_edits(file_.bytes, std::move(edits_));
  }

 private:
  bool is_written(const SvgShape& shape, const SvgPiece& piece) const {
    return piece.curve && (is_moved(piece) || shape.kind == "use");
  }

  bool is_moved(const SvgPiece& piece) const {
    return piece.curve && moved_[*piece.curve].points != file_.curves[*piece.curve].points;
  }

  /// The points of a moved curve in the coordinates of its element.
  std::vector<Vec2> points_of(const SvgShape& shape, const SvgPiece& piece) {
    const Curve& curve = moved_[*piece.curve];
    const std::vector<std::ptrdiff_t> own = own_points(file_.curves[*piece.curve], curve);
    std::vector<Vec2> result;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const Vec2 place(curve.points[2 * i], curve.points[2 * i + 1]);
      const bool is_own = own[i] >= 0 && places_.is_read_as(place, piece.path.points[static_cast<std::size_t>(own[i])],
                                                            shape.transform);
      result.push_back(is_own ? piece.path.points[static_cast<std::size_t>(own[i])]
                              : places_.local(place, shape.transform));
    }
    return result;
  }

  std::string data_of(const SvgShape& shape, const SvgPiece& piece) {
    const Curve& curve = moved_[*piece.curve];
    const std::vector<Vec2> points = points_of(shape, piece);
    const auto is_shared = [&](std::size_t k) {
      return places_.is_shared({curve.points[2 * k], curve.points[2 * k + 1]});
    };
    std::string text = "M " + text_of(points[0]);
    const CurveWriting writing = writing_.empty() ? CurveWriting::smooth : writing_[*piece.curve];
    if (writing == CurveWriting::polyline) {
      for (std::size_t k = 1; k < points.size(); ++k) text += " " + text_of(points[k]);
    } else {
      bool is_curve = false;  // further pairs of numbers behind a move-to are segments
      for (const PathStep& step : drawn_.along(curve, writing == CurveWriting::smooth, file_.flatten, is_shared)) {
        if (!step.controls && step.to == 0) continue;  // closing says it
        if (step.controls.has_value() != is_curve) text += is_curve ? " L" : " C";
        is_curve = step.controls.has_value();
        for (int k = 0; is_curve && k < 2; ++k)
          text += " " + text_of(places_.control((*step.controls)[k], shape.transform));
        text += " " + text_of(points[step.to]);
      }
    }
    return curve.closed ? text + " Z" : text;
  }

  std::string path_of(const SvgShape& shape) {
    std::string text;
    for (const SvgPiece& piece : shape.pieces) {
      if (!text.empty()) text += ' ';
      if (is_written(shape, piece)) {
        text += data_of(shape, piece);
      } else {
        text += "M " + text_of(piece.path.start);
        if (piece.path.implicit != 0) text += fmt::format(" {}", piece.path.implicit);
        std::string rest = shape.data.substr(piece.path.begin, piece.path.end - piece.path.begin);
        while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\n')) rest.pop_back();
        text += rest;
      }
    }
    return text;
  }

  /// A <use> becomes a group with a path: the attributes that do not say what it shows are those of the group.
  void replace_use(const SvgShape& shape, const std::string& data, const Attributes& attributes) {
    const std::size_t colon = file_.bytes.find_first_of(": \t\r\n/>", shape.name);
    const std::size_t name = file_.bytes[colon] == ':' ? colon + 1 : shape.name;
    const std::string prefix = file_.bytes.substr(shape.name, name - shape.name);
    edits_.push_back({name, name + shape.kind.size(), "g"});
    std::size_t behind = name + shape.kind.size();
    for (const auto& [key, attribute] : attributes) {
      behind = std::max(behind, attribute.end);
      for (const char* const showing : {"href", "xlink:href", "x", "y", "width", "height"})
        if (key == showing) edits_.push_back({attribute.begin - 1, attribute.end, ""});
    }
    const std::string path = fmt::format("<{}path{} d=\"{}\"/>", prefix, shape.style, data);
    const std::size_t tag_end = file_.bytes.find('>', behind);
    if (file_.bytes[tag_end - 1] == '/') {
      edits_.push_back({tag_end - 1, tag_end + 1, fmt::format(">{}</{}g>", path, prefix)});
    } else {
      edits_.push_back({tag_end + 1, tag_end + 1, path});
      const std::size_t at = end_tag_of(file_.bytes, tag_end) + 2 + prefix.size();
      edits_.push_back({at, at + shape.kind.size(), "g"});
    }
  }

  /// A line, rect, circle or ellipse becomes a path: its name, and its measures.
  void become_path(const SvgShape& shape, const SvgPiece& piece, const Attributes& attributes) {
    const std::size_t colon = file_.bytes.find_first_of(": \t\r\n/>", shape.name);
    const std::size_t name = file_.bytes[colon] == ':' ? colon + 1 : shape.name;
    edits_.push_back({name, name + shape.kind.size(), "path"});
    const std::string data = fmt::format("d=\"{}\"", data_of(shape, piece));
    bool is_written = false;
    std::size_t behind = name + shape.kind.size();
    for (const auto& [key, attribute] : attributes) {
      behind = std::max(behind, attribute.end);
      for (const char* const measure : measures)
        if (key == measure) {
          // A space before it goes too, unless the data comes in its place.
          const std::size_t begin = attribute.begin - (is_written ? 1 : 0);
          edits_.push_back({begin, attribute.end, is_written ? "" : data});
          is_written = true;
        }
    }
    if (!is_written) edits_.push_back({behind, behind, " " + data});
    const std::size_t tag_end = file_.bytes.find('>', behind);
    if (file_.bytes[tag_end - 1] != '/') {
      const std::size_t at = end_tag_of(file_.bytes, tag_end) + 2 + (name - shape.name);
      edits_.push_back({at, at + shape.kind.size(), "path"});
    }
  }

  const SvgFile& file_;
  std::span<const Curve> moved_;
  std::span<const CurveWriting> writing_;  // one a curve; empty: all smooth
  TransformedPlaces places_;
  DrawnPieces drawn_;
  std::vector<TextEdit> edits_;
};

}  // namespace

std::string SvgFile::patched(std::span<const Curve> moved, double rounding,
                             std::span<const CurveWriting> writing) const {
  return SvgPatch(*this, moved, rounding, writing)();
}

}  // namespace unsnarl
