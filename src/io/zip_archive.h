#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace unsnarl {

/// The entries of a ZIP archive in memory.
class ZipArchive {
 public:
  /// `bytes` has to outlive this. Throws FileError where it is no archive, or a damaged one.
  explicit ZipArchive(std::string_view bytes);
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;
  ~ZipArchive();

  /// Returns the content of an entry, whatever the case of its name; nothing: there is none. Throws FileError where it
  /// is damaged, encrypted, or compressed in a way that is not supported.
  std::optional<std::string> content(const std::string& name) const;
  /// The archive with other content of these entries, by their names, which are there; compressed as before, of the
  /// same time; all other entries as they are. Throws WriteError.
  std::string with_contents(const std::map<std::string, std::string>& contents) const;

 private:
  struct Handle;
  std::string_view bytes_;
  std::unique_ptr<Handle> handle_;
};

}  // namespace unsnarl
