#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace unsnarl::app {

/// What the journals of a batch say of one mesh under one key (its content, the options, the program).
struct JournalEntry {
  std::string line;     ///< the last result, a JSON object in one line; empty: none yet
  int unexplained = 0;  ///< times that a worker started and the batch ended before it, since the last result
};

/// What has been done in a folder of results: one JSON object a line, {"started": key}, {"stopped": key} or a result
/// with "key". A run appends to the journal of its shard, and reads those of all. Lines that were cut off when a run
/// was killed are skipped.
class BatchJournal {
 public:
  /// Reads the journals in `folder`, which need not exist.
  explicit BatchJournal(const std::filesystem::path& folder);
  ~BatchJournal();
  BatchJournal(const BatchJournal&) = delete;
  BatchJournal& operator=(const BatchJournal&) = delete;

  /// Opens FOLDER/NAME.jsonl for the lines to come, for this process alone. Throws WriteError: it cannot be written, or
  /// another run on this machine works on the same shard.
  void open(const std::filesystem::path& folder, const std::string& name);

  /// nullptr: nothing is known of this key.
  const JournalEntry* find(const std::string& key) const;

  // By any thread. Throw WriteError.
  void started(const std::string& key);
  void stopped(const std::string& key);
  void ended(const std::string& key, const std::string& result);

 private:
  void take(std::string_view line);
  void append(const std::string& line);

  std::map<std::string, JournalEntry> entries_;
  mutable std::mutex mutex_;
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace unsnarl::app
