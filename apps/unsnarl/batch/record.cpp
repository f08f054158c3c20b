#include "batch/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "input_bytes.h"
#include "platform/process.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/intersections.h"
#include "unsnarl/visible_text.h"

namespace unsnarl::app {
namespace {

/// Numbers of a report that are taken over as they are.
const std::vector<std::string> measured = {"diagonal",
                                           "displacement_mean_rel",
                                           "displacement_rms_rel",
                                           "displacement_area_rms_rel",
                                           "displacement_max_rel",
                                           "displacement_lower_bound_rel",
                                           "untouched_share",
                                           "flipped_triangles",
                                           "flipped_triangles_without_conflict",
                                           "min_gap_rel",
                                           "volume_change_rel",
                                           "area_change_rel",
                                           "edge_stretch_max",
                                           "edge_stretch_p999",
                                           "float32_embedded"};

constexpr std::size_t longest_message = 500;  // bytes

/// The last line of what a worker said, where programs put the reason.
std::string last_line(const std::filesystem::path& path) {
  std::string text = bytes_if_readable(path.string());
  while (!text.empty() && text.back() == '\n') text.pop_back();
  text = text.substr(text.rfind('\n') + 1);
  if (text.starts_with("unsnarl: ")) text = text.substr(9);
  return text.substr(0, longest_message);
}

std::string status_of(const WorkerEnd& end, const Record& report) {
  if (end.timed_out) return std::string(to_string(Status::time_limit));
  if (end.exit_code < 0 || end.exit_code == exit_cancelled) return status_killed;
  if (report.contains("status") && report["status"].is_string()) return report["status"];
  switch (end.exit_code) {
    case exit_usage: return status_usage_error;
    case exit_invalid_input: return status_invalid_input;
    case exit_cannot_write: return status_cannot_write;
    case exit_system_error: return status_system_error;
    case exit_limit: return std::string(to_string(Status::memory_limit));
    default: return status_internal_error;
  }
}

std::string message_of(const WorkerEnd& end, const std::filesystem::path& standard_error) {
  if (end.timed_out) return "killed, because it did not stop at the time limit";
  if (end.exit_code < 0) return "its process was killed by " + platform::reason_of_death(end.exit_code);
  if (end.exit_code == exit_cancelled) return "its process was interrupted";
  return last_line(standard_error);
}

/// "kind, kind" of the objects in a list, each once.
std::string kinds(const Record& list) {
  std::set<std::string> names;
  for (const Record& entry : list) names.insert(entry.value("kind", "?"));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// "message; message" of the objects in a list.
std::string messages(const Record& list) {
  std::string text;
  for (const Record& entry : list) text += (text.empty() ? "" : "; ") + entry.value("message", "?");
  return text;
}

std::string counted(const Record& numbers) {
  std::string text;
  for (const auto& [name, number] : numbers.items())
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number.dump(), name);
  return text;
}

void take_report(Record& record, const Record& report) {
  const auto at = [&report](const char* pointer) {
    const Record::json_pointer where(pointer);
    return report.contains(where) ? report[where] : Record();
  };
  record["vertices"] = at("/input/vertices");
  record["faces"] = at("/input/faces");
  record["components"] = at("/topology/components");
  record["pairs_before"] = at("/before/total");
  record["pairs_left"] = at("/after/total");
  record["allowed_before"] = at("/allowed/before/total");
  record["allowed_after"] = at("/allowed/after/total");
  for (const char* side : {"before", "after"}) {
    const Record by_class = at(fmt::format("/{}/by_class", side).c_str());
    for (const auto& [kind, number] : by_class.items()) record[fmt::format("{}_{}", side, kind)] = number;
  }
  for (const std::string& name : measured) record[name] = at(("/" + name).c_str());
  record["dihedral_deg"] = at("/clearance/after/dihedral_deg/value");
  record["gap_rel"] = at("/clearance/after/gap_rel/value");
  record["obstructions"] = kinds(at("/obstructions"));
  record["left_because"] = counted(at("/left/by_reason"));
  record["changed_components"] = messages(at("/changed_components"));
}

}  // namespace

const std::vector<std::string>& record_columns() {
  static const std::vector<std::string> columns = [] {
    std::vector<std::string> names = {"mesh",  "status",     "exit_code",    "vertices",
                                      "faces", "components", "pairs_before", "pairs_left"};
    names.insert(names.end(), measured.begin(), measured.end());
    names.insert(names.end(), {"dihedral_deg", "gap_rel"});
    for (const char* side : {"before", "after"})
      for (const auto& kind : pair_class_names) names.push_back(fmt::format("{}_{}", side, kind));
    names.insert(names.end(), {"allowed_before", "allowed_after"});
    names.insert(names.end(), {"obstructions", "left_because", "changed_components", "message", "output", "partial",
                               "input_sha256", "output_sha256"});
    return names;
  }();
  return columns;
}

std::string as_utf8(const std::string& name) {
  return is_utf8(name) ? name : visible_text(name);
}

Record record_of(const std::string& mesh, const WorkerEnd& end, const std::filesystem::path& report_path,
                 const std::filesystem::path& standard_error) {
  const Record report = Record::parse(bytes_if_readable(report_path.string()), nullptr, false);
  const bool is_whole = report.is_object() && report.contains("before");  // else the mesh was refused
  Record record;
  record["mesh"] = as_utf8(mesh);
  record["status"] = status_of(end, is_whole ? report : Record::object());
  record["exit_code"] = end.timed_out ? static_cast<int>(exit_limit) : end.exit_code;
  if (is_whole) take_report(record, report);
  record["message"] = message_of(end, standard_error);
  record["run"] = {{"seconds", end.seconds}, {"cpu_s", end.cpu_s}, {"peak_memory_mb", end.peak_memory_mb}};
  return record;
}

}  // namespace unsnarl::app
