#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "platform/locks.h"

namespace unsnarl::app {

/// The frames that are done, one JSON line each in a file beside the outputs. A frame is done where its last line has
/// the key of what is asked for now (program, options, the content of all frames that have an influence on it) and the
/// SHA-256 of the output as it is there. A line is written after its output, so whatever ends the program, no line
/// promises what is not there; a line that was cut off is no line.
class SequenceRecord {
 public:
  using Json = nlohmann::ordered_json;

  explicit SequenceRecord(std::filesystem::path path);

  /// Waits for other calls, then reads what they have added. While the file that it returns lives, they wait; where the
  /// file system has no locks, nobody does. Throws WriteError, SystemError.
  std::unique_ptr<platform::LockedFile> lock();

  /// The line of a frame that is done; null: it is not.
  const Json* find(const std::string& name, const std::string& key, const std::string& output_hash) const;
  /// Throws WriteError.
  void add(const std::string& name, const std::string& key, const std::string& output_hash, Json report);

 private:
  void read();

  std::filesystem::path path_;
  std::map<std::string, Json> lines_;  // the last of each frame
  bool ends_in_a_line_ = true;
};

}  // namespace unsnarl::app
