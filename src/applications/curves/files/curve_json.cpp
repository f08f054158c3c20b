#include <fmt/format.h>

#include <charconv>

#include "applications/curves/files/curve_file.h"
#include "applications/curves/files/written_places.h"
#include "io/json_text.h"
#include "io/text_edits.h"

namespace unsnarl {
namespace {

class JsonCurveFile final : public CurveFile {
 public:
  struct Place {
    std::size_t begin = 0, end = 0;                           // of the list of points
    std::vector<std::pair<std::size_t, std::size_t>> tokens;  // of each coordinate
  };

  std::string patched(std::span<const Curve> moved, double rounding,
                      std::span<const CurveWriting> /*writing*/) const override {
    const WrittenPlaces written_at(curves, moved, rounding);
    std::vector<TextEdit> edits;
    for (std::size_t c = 0; c < moved.size(); ++c) {
      const std::vector<double>&now = moved[c].points, &own = curves[c].points;
      if (now == own) continue;
      std::string list = "[";
      for (std::size_t k = 0; k + 1 < now.size(); k += 2) {
        const Vec2 written = written_at({now[k], now[k + 1]});
        list += fmt::format("{}[{}, {}]", k == 0 ? "" : ", ", digits_of(written.x()), digits_of(written.y()));
        for (std::size_t axis = 0; now.size() == own.size() && axis < 2; ++axis)
          if (now[k + axis] != own[k + axis])
            edits.push_back({places[c].tokens[k + axis].first, places[c].tokens[k + axis].second,
                             digits_of(written[static_cast<Index>(axis)])});
      }
      // Points were inserted: the list is written anew.
      if (now.size() != own.size()) edits.push_back({places[c].begin, places[c].end, list + "]"});
    }
    return with_edits(bytes, std::move(edits));
  }
  std::unique_ptr<CurveFile> parse_alike(std::string text, double /*part_of_tolerance*/) const override {
    return parse_curve_json(std::move(text));
  }

  std::vector<Place> places;
};

[[noreturn]] void refuse(const JsonText::Value& value, const std::string& what) {
  throw FileError(fmt::format("byte {}: {}", value ? value.begin() : 0, what));
}

}  // namespace

std::unique_ptr<CurveFile> parse_curve_json(std::string bytes) {
  auto file = std::make_unique<JsonCurveFile>();
  file->bytes = std::move(bytes);
  const JsonText json(file->bytes);
  const JsonText::Value list = json.root()["curves"];
  if (!list.is_array())
    throw FileError("there is no list \"curves\"; give {\"curves\": [{\"points\": [[x, y], ...], \"closed\": true}]}");
  for (const JsonText::Value& item : list.elements()) {
    const std::size_t number = file->curves.size();
    const std::string which = fmt::format("curve {}", number);
    if (!item.is_object()) refuse(item, which + " is not an object with \"points\"");
    const JsonText::Value points = item["points"];
    if (!points.is_array()) refuse(item, which + " has no list \"points\"");
    Curve curve;
    curve.name = item["name"].string();
    if (!curve.name.empty()) curve.name = fmt::format("curve {} '{}'", number, curve.name);
    JsonCurveFile::Place place{points.begin(), points.end(), {}};
    for (const JsonText::Value& point : points.elements()) {
      const std::vector<JsonText::Value> xy = point.elements();
      if (xy.size() != 2) refuse(point, fmt::format("{}: point {} is not [x, y]", which, curve.size()));
      const std::size_t k = curve.size();
      for (const JsonText::Value& coordinate : xy) {
        const std::optional<double> value = coordinate.number();
        if (!value) refuse(coordinate, fmt::format("{}: a coordinate of point {} is not a finite number", which, k));
        curve.points.push_back(*value);
        place.tokens.emplace_back(coordinate.begin(), coordinate.end());
      }
    }
    if (const JsonText::Value closed = item["closed"]) {
      if (closed.text() != "true" && closed.text() != "false")
        refuse(closed, fmt::format("{}: \"closed\" is {}; give true or false", which, closed.text()));
      curve.closed = closed.text() == "true";
    }
    if (const JsonText::Value fixed = item["fixed"]) {
      curve.fixed.assign(curve.size(), fixed.text() == "true");
      if (!fixed.is_array() && fixed.text() != "true" && fixed.text() != "false")
        refuse(fixed, which + ": \"fixed\" is neither true, false nor a list of points");
      for (const JsonText::Value& id : fixed.elements()) {
        const std::optional<std::size_t> k = id.index();
        if (!k || *k >= curve.size())
          refuse(id, fmt::format("{}: there is no point {} to fix; it has {} points, counted from 0", which, id.text(),
                                 curve.size()));
        curve.fixed[*k] = 1;
      }
    }
    file->ids.push_back(item["name"].string());
    file->curves.push_back(std::move(curve));
    file->places.push_back(std::move(place));
  }
  return file;
}

}  // namespace unsnarl
