#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "unsnarl/appearance.h"

namespace unsnarl {

/// Gathers the images of an Appearance: each once, PNG and JPEG alone, as long as there is room. What cannot be taken
/// is in its notes.
class ImageCollector {
 public:
  /// room: bytes that all images together may have.
  ImageCollector(Appearance& appearance, std::size_t room) : appearance_(appearance), room_(room), whole_room_(room) {}

  /// Gives the image, which `take` hands over, where it was not asked for yet. Throws FileError where there is none.
  using Take = std::function<std::string()>;
  /// The index of the image of this name; -1: it cannot be shown.
  std::int32_t add(const std::string& name, const Take& take);

  /// Throws FileError where so many bytes are more than there is room for.
  void require_room(std::uintmax_t bytes) const;
  /// The bytes of a file that another file names, relative to its folder. Throws FileError.
  std::string read_beside(const std::filesystem::path& folder, const std::filesystem::path& name) const;

 private:
  Appearance& appearance_;
  std::size_t room_;
  const std::size_t whole_room_;
  std::map<std::string, std::int32_t> known_;
};

}  // namespace unsnarl
