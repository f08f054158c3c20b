#include "sequence/record.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <utility>

#include "input_bytes.h"
#include "unsnarl/depth_limit.h"

namespace unsnarl::app {

SequenceRecord::SequenceRecord(std::filesystem::path path) : path_(std::move(path)) {
  read();
}

std::unique_ptr<platform::LockedFile> SequenceRecord::lock() {
  auto lock = std::make_unique<platform::LockedFile>();
  if (const int failed = lock->open(path_); failed != 0)
    throw_write_error(path_.string() + ": cannot be written", failed);
  lock->lock();
  read();
  return lock;
}

void SequenceRecord::read() {
  lines_.clear();
  ends_in_a_line_ = true;
  std::istringstream file(bytes_if_readable(path_.string()));
  for (std::string line; std::getline(file, line);) {
    ends_in_a_line_ = !file.eof();
    if (too_deep_bracket(line) != std::string::npos) continue;
    Json json = Json::parse(line, nullptr, false);
    if (!json.is_object() || !json.contains("name") || !json["name"].is_string()) continue;
    const std::string name = json["name"].get<std::string>();
    lines_[name] = std::move(json);
  }
}

const SequenceRecord::Json* SequenceRecord::find(const std::string& name, const std::string& key,
                                                 const std::string& output_hash) const {
  const auto line = lines_.find(name);
  if (line == lines_.end() || output_hash.empty()) return nullptr;
  const Json& json = line->second;
  const bool is_same = json.value("key", Json()) == key && json.value("output_sha256", Json()) == output_hash &&
                       json.value("report", Json()).is_object();
  return is_same ? &json : nullptr;
}

void SequenceRecord::add(const std::string& name, const std::string& key, const std::string& output_hash, Json report) {
  Json json = {{"name", name}, {"key", key}, {"output_sha256", output_hash}, {"report", std::move(report)}};
  std::ofstream file(path_, std::ios::app | std::ios::binary);
  // A line that was cut off is ended first.
  file << (std::exchange(ends_in_a_line_, true) ? "" : "\n")
       << json.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
  file.flush();
  if (!file) throw WriteError(path_.string() + ": cannot be written; the disk may be full");
  lines_[name] = std::move(json);
}

}  // namespace unsnarl::app
