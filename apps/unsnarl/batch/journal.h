#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "platform/locks.h"

namespace unsnarl::app {

/// Sum of what the journals of a batch say of one mesh under one key (its content, the options, the program).
struct JournalEntry {
  std::string line;     ///< the last result, a JSON object in one line; empty: none yet
  int unexplained = 0;  ///< times that a worker started and the batch ended before it, since the last result
};

/// Log of what has been done in a folder of results: one JSON object a line, {"started": key}, {"stopped": key} or a
/// result with "key". A run appends to the journal of its shard, and reads those of all. Lines that were cut off when a
/// run was killed are skipped.
class BatchJournal {
 public:
  /// Reads the journals in `folder`, which need not exist. Throws SystemError.
  explicit BatchJournal(const std::filesystem::path& folder) : folder_(folder) { read(); }

  /// Opens NAME.jsonl for the lines to come, for this process alone: waits until another run on this machine that works
  /// on the same shard has ended, after calling `before_waiting`. Then reads all journals anew. Throws WriteError,
  /// SystemError.
  void open(const std::string& name, const std::function<void()>& before_waiting);

  /// nullptr: nothing is known of this key.
  const JournalEntry* find(const std::string& key) const;

  // By any thread. Throw WriteError, SystemError.
  void started(const std::string& key);
  void stopped(const std::string& key);
  void ended(const std::string& key, const std::string& result);

 private:
  void read();
  void take(std::string_view line);
  void append(const std::string& line);

  std::map<std::string, JournalEntry> entries_;
  mutable std::mutex mutex_;
  std::filesystem::path folder_, path_;
  platform::LockedFile file_;
};

}  // namespace unsnarl::app
