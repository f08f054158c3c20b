#pragma once

#include <span>
#include <string>

#include "staged_output.h"
#include "unsnarl/repair.h"
#include "unsnarl/scene_document.h"

namespace unsnarl::app {

/// The kind of picture that --picture asks for, by its name.
enum class PictureKind {
  still,   ///< before and after, PNG
  gif,     ///< *.gif: an animation
  folder,  ///< a folder, there or ending in '/': the pictures of the animation, as 0000.png, 0001.png, ...
};
PictureKind picture_kind(const std::string& path);

/// Makes sure that there is an empty folder. Throws UsageError, WriteError.
void prepare_picture_folder(const std::string& path, const std::string& option);

/// Adds the frames of a repair of `surface`, which is of `files`, as a GIF or into a folder. Throws WriteError.
void add_animation(const std::string& path, const SurfaceView& surface, std::span<const SceneFile> files,
                   const RepairResult& result, StagedOutput& outputs);

}  // namespace unsnarl::app
