#include "io/surface_builder.h"

#include <fmt/format.h>

namespace unsnarl {

void FaceCollector::note_ignored(std::vector<std::string>& notes) const {
  if (ignored_ > 0) {
    notes.push_back(
        fmt::format("{} face{} with fewer than three corners stay{} in the file but {} not part of the surface.",
                    ignored_, ignored_ == 1 ? "" : "s", ignored_ == 1 ? "s" : "", ignored_ == 1 ? "is" : "are"));
  }
}

}  // namespace unsnarl
