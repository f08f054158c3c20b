#include "batch/journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "input_bytes.h"
#include "platform/files.h"
#include "unsnarl/depth_limit.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

}  // namespace

void BatchJournal::read() {
  entries_.clear();
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".jsonl") files.push_back(it->path());
  if (is_error_of_system(platform::errno_of(error)))
    throw_read_error(folder_.string() + ": cannot list the folder", platform::errno_of(error));
  std::sort(files.begin(), files.end());
  for (const fs::path& path : files) {
    std::istringstream file(bytes_if_readable(path.string()));
    for (std::string line; std::getline(file, line);) take(line);
  }
}

void BatchJournal::open(const std::string& name, const std::function<void()>& before_waiting) {
  path_ = folder_ / (name + ".jsonl");
  if (const int failed = file_.open(path_); failed != 0)
    throw_write_error(path_.string() + ": cannot be written", failed);
  // A file system without locks is no reason to do nothing: two runs at once do the same work and write the same bytes.
  if (!file_.try_lock()) {
    before_waiting();
    file_.lock();
  }
  if (file_.ends_in_the_middle_of_a_line()) append("");
  read();
}

const JournalEntry* BatchJournal::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(key);
  return found == entries_.end() ? nullptr : &found->second;
}

void BatchJournal::started(const std::string& key) {
  append(Json{{"started", key}}.dump());
}

void BatchJournal::stopped(const std::string& key) {
  append(Json{{"stopped", key}}.dump());
}

void BatchJournal::ended(const std::string& key, const std::string& result) {
  append(result);
  const std::lock_guard lock(mutex_);
  entries_[key] = {result, 0};
}

void BatchJournal::take(std::string_view line) {
  if (too_deep_bracket(line) != std::string_view::npos) return;
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) return;
  const auto word = [&json](const char* name) {
    const auto found = json.find(name);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  if (const std::string key = word("started"); !key.empty()) {
    ++entries_[key].unexplained;
  } else if (const std::string stopped = word("stopped"); !stopped.empty()) {
    --entries_[stopped].unexplained;
  } else if (const std::string ended = word("key"); !ended.empty()) {
    entries_[ended] = {std::string(line), 0};
  }
}

void BatchJournal::append(const std::string& line) {
  const std::string bytes = line + '\n';
  const std::lock_guard lock(mutex_);
  if (const int failed = file_.append(bytes); failed != 0)
    throw_write_error(path_.string() + ": cannot be written", failed);
}

}  // namespace unsnarl::app
