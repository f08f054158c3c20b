#include "unsnarl/scene_document.h"

namespace unsnarl {

std::vector<std::int32_t> file_of_faces(std::span<const SceneFile> files) {
  std::vector<std::int32_t> file_of;
  for (std::size_t i = 0; i < files.size(); ++i) file_of.insert(file_of.end(), files[i].faces, static_cast<int>(i));
  return file_of;
}

}  // namespace unsnarl
