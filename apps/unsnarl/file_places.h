#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "interruption.h"

namespace unsnarl::app {

/// The files that one call reads and the places that it writes to. No output replaces what is read, or another output:
/// each command names all of its files here before it works.
class FilePlaces {
 public:
  static constexpr const char* other_name = "it would be overwritten: give another name";

  /// `what` is named in messages: "the input", "--fix-vertices". Empty paths and streams are passed over.
  /// Throws UsageError where an output has this place.
  void reads(const std::string& what, const std::string& path);
  /// Standard output takes one output; pipes and devices any number. `advice` says what to do instead.
  /// Throws UsageError where an input or another output has this place.
  void writes(const std::string& what, const std::string& path, const std::string& advice = other_name);
  /// The same of files of these names beside an output `main`, relative to its folder; they may be in subfolders that
  /// are not there yet.
  void writes_beside(const std::string& what, const std::filesystem::path& main,
                     const std::vector<std::filesystem::path>& names, const std::string& advice = other_name);
  /// Has an input or an output this place?
  bool has(const std::filesystem::path& path) const;
  /// Finds out whether files can be made at the places of all outputs. Throws WriteError.
  void require_writable(Interruption& interruption) const;

 private:
  struct File {
    std::string what, advice;
    bool is_written = false;
  };
  void claim(const std::filesystem::path& path, const File& file);

  std::map<std::string, File> files_;  // by what two paths of one file have in common, see identities_of()
  std::vector<std::filesystem::path> outputs_;
  std::map<std::filesystem::path, std::vector<std::filesystem::path>> beside_;  // names by the main file
};

}  // namespace unsnarl::app
