#include <fmt/format.h>

#include <stdexcept>

#include "io/parse_json.h"
#include "unsnarl/document.h"
#include "unsnarl/knot_isotopy.h"
#include "unsnarl/version.h"

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& place, const std::string& what) {
  throw FileError(fmt::format("{}: {}", place, what));
}

const Json& member(const Json& value, const std::string& place, const char* key) {
  if (!value.is_object()) refuse(place, "this is not an object");
  const auto found = value.find(key);
  if (found == value.end()) refuse(place, fmt::format("\"{}\" is missing", key));
  return *found;
}

const Json& list(const Json& value, const std::string& place) {
  if (!value.is_array()) refuse(place, "this is not a list");
  return value;
}

double number(const Json& value, const std::string& place) {
  if (!value.is_number()) refuse(place, "this is not a number");
  return value.get<double>();
}

int whole_number(const Json& value, const std::string& place) {
  if (!value.is_number_integer()) refuse(place, "this is not a whole number");
  const auto wide = value.get<std::int64_t>();
  if (wide < 0 || wide > std::numeric_limits<std::int32_t>::max())
    refuse(place, fmt::format("{} is out of range", wide));
  return static_cast<int>(wide);
}

std::vector<int> whole_numbers(const Json& root, const char* key) {
  std::vector<int> numbers;
  for (const Json& item : list(member(root, "the file", key), key))
    numbers.push_back(whole_number(item, fmt::format("{}[{}]", key, numbers.size())));
  return numbers;
}

Json as_json(const std::vector<KnotDoublePoint>& points) {
  Json json = Json::array();
  for (const KnotDoublePoint& p : points) json.push_back({{"time", p.time}, {"sign", p.sign}, {"place", p.place}});
  return json;
}

}  // namespace

std::string knot_isotopy_json(const KnotIsotopy& isotopy, const KnotIsotopyFindings& findings) {
  Json json = {{"schema", "unsnarl-knot-isotopy"},
               {"schema_version", 1},
               {"version", version},
               {"status", to_string(isotopy.status)},
               {"found", isotopy.found},
               {"hold", findings.hold()},
               {"ends_kept", findings.ends_kept},
               {"meeting_triangles", findings.meeting_triangles},
               {"unproven_motions", findings.unproven_motions},
               {"relaxed", isotopy.relaxed},
               {"start_energy", isotopy.start_energy},
               {"end_energy", isotopy.end_energy},
               {"straight_double_points", as_json(isotopy.straight_double_points)},
               {"left_double_points", as_json(isotopy.left_double_points)},
               {"seconds", isotopy.seconds},
               {"reversed", isotopy.reversed},
               {"start_pieces", isotopy.start_pieces},
               {"end_pieces", isotopy.end_pieces},
               {"end_first", isotopy.end_first},
               {"rings", Json::array()}};
  for (const KnotRing& ring : isotopy.rings) {
    Json points = Json::array();
    for (std::size_t k = 0; k + 2 < ring.points.size(); k += 3)
      points.push_back({ring.points[k], ring.points[k + 1], ring.points[k + 2]});
    json["rings"].push_back({{"time", ring.time}, {"points", std::move(points)}});
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

KnotIsotopy parse_knot_isotopy(std::string_view text) {
  const Json root = parse_json(text);
  KnotIsotopy isotopy;
  for (const Json& item : list(member(root, "the file", "rings"), "rings")) {
    const std::string place = fmt::format("rings[{}]", isotopy.rings.size());
    KnotRing ring;
    ring.time = number(member(item, place, "time"), place + ".time");
    std::size_t k = 0;
    for (const Json& point : list(member(item, place, "points"), place + ".points")) {
      const std::string here = fmt::format("{}.points[{}]", place, k++);
      if (!point.is_array() || point.size() != 3) refuse(here, "give [x, y, z]");
      for (const Json& coordinate : point) ring.points.push_back(number(coordinate, here));
    }
    isotopy.rings.push_back(std::move(ring));
  }
  isotopy.start_pieces = whole_numbers(root, "start_pieces");
  isotopy.end_pieces = whole_numbers(root, "end_pieces");
  isotopy.end_first = whole_number(member(root, "the file", "end_first"), "end_first");
  const Json& reversed = member(root, "the file", "reversed");
  if (!reversed.is_boolean()) refuse("reversed", "give true or false");
  isotopy.reversed = reversed.get<bool>();
  return isotopy;
}

}  // namespace unsnarl
