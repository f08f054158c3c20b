#include "io/image_collector.h"

#include <fmt/format.h>

#include <system_error>

#include "io/image_header.h"
#include "io/linked_file.h"
#include "io/mesh_file.h"

namespace unsnarl {

std::int32_t ImageCollector::add(const std::string& name, const Take& take) {
  const auto [entry, is_new] = known_.try_emplace(name, -1);
  if (!is_new) return entry->second;
  try {
    std::string bytes = take();
    require_room(bytes.size());
    const std::optional<ImageHeader> header = image_header(bytes);
    if (!header) throw FileError("neither PNG nor JPEG");
    if (header->width > most_image_pixels / header->height)
      throw FileError(fmt::format("{} x {} pixels; {} million are the most", header->width, header->height,
                                  most_image_pixels / 1000000));
    room_ -= bytes.size();
    entry->second = static_cast<std::int32_t>(appearance_.images.size());
    appearance_.images.push_back({name, header->media_type, std::move(bytes), header->width, header->height});
  } catch (const NumberedError& error) {  // of the file or of the system: a view goes without it
    appearance_.notes.push_back(fmt::format("Image {} is left out: {}.", name, error.what()));
  }
  return entry->second;
}

void ImageCollector::require_room(std::uintmax_t bytes) const {
  if (bytes <= room_) return;
  constexpr double megabytes_a_byte = 1e-6;  ///< Megabytes of a byte (fixed by SI units)
  throw FileError(fmt::format("{:.1f} MB; all images together may have {:.0f} MB",
                              megabytes_a_byte * static_cast<double>(bytes),
                              megabytes_a_byte * static_cast<double>(whole_room_)));
}

std::string ImageCollector::read_beside(const std::filesystem::path& folder, const std::filesystem::path& name) const {
  const std::filesystem::path place = linked_file(folder, name);
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(place, failed);
  if (!failed) require_room(size);
  return read_file(place);
}

}  // namespace unsnarl
