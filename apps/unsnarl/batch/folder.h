#pragma once

#include <filesystem>
#include <string>

#include "batch/inputs.h"

namespace unsnarl::app {

/// Names the files in the folder of a batch's results. Paths within it are relative to `root`.
struct BatchFolder {
  std::filesystem::path root;

  /// The repaired mesh. A glTF has a folder of its own, for its buffers keep their names.
  static std::string mesh(const std::string& name);
  static std::string report(const std::string& name) { return "reports/" + name + ".json"; }
  static std::string thumbnail(const std::string& name) { return "thumbnails/" + name + ".png"; }
  std::filesystem::path journal() const { return root / "journal"; }
  /// For what the workers of a shard have not finished.
  std::filesystem::path work(const Shard& shard) const { return root / "work" / shard.name(); }

  /// Makes the folder; refuses one that holds something else. Throws UsageError, WriteError.
  void prepare() const;
  /// Moves a file, or removes what is at its place where there is none. Makes the folders on the way.
  /// Throws WriteError. False: there was none.
  bool take_over(const std::filesystem::path& from, const std::string& to) const;
};

}  // namespace unsnarl::app
