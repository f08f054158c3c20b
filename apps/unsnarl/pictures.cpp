#include "pictures.h"

#include <fmt/format.h>

#include <filesystem>

#include "platform/files.h"
#include "staged_output.h"
#include "unsnarl/paths.h"
#include "unsnarl/pictures.h"
#include "usage_error.h"

namespace unsnarl::app {

namespace fs = std::filesystem;

PictureKind picture_kind(const std::string& path) {
  std::error_code ignored;
  if (path.ends_with('/') || fs::is_directory(path_of(path), ignored)) return PictureKind::folder;
  return path.ends_with(".gif") || path.ends_with(".GIF") ? PictureKind::gif : PictureKind::still;
}

void prepare_picture_folder(const std::string& path, const std::string& option) {
  std::error_code error;
  fs::create_directories(path_of(path), error);
  if (error) throw_write_error(path + ": cannot make this folder", platform::errno_of(error));
  const bool is_empty = fs::is_empty(path_of(path), error);
  if (error) throw_write_error(path + ": cannot list this folder", platform::errno_of(error));
  if (!is_empty)
    throw UsageError(fmt::format("{} {}: this folder is not empty; use another one, or empty it first", option, path));
}

void add_animation(const std::string& path, const SurfaceView& surface, std::span<const SceneFile> files,
                   const RepairResult& result, StagedOutput& outputs) {
  const AnimationOptions options{.files = files};
  if (picture_kind(path) == PictureKind::gif) return outputs.add(path, animation_gif(surface, result.frames, options));
  int number = 0;
  animation_pngs(surface, result.frames, options, [&](const std::string& png) {
    outputs.add((path_of(path) / fmt::format("{:04}.png", number++)).string(), png);
  });
}

}  // namespace unsnarl::app
