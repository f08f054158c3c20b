#pragma once

#include <string>
#include <vector>

#include "render/image.h"
#include "unsnarl/surface.h"

namespace unsnarl::peers {

struct Exhibit {
  Surface surface;
  std::string label;  ///< '\n' starts a second, smaller line
};

/// Surfaces beside each other and below, seen by one camera unless they are twice as large as the first, intersecting
/// faces in red. `width`: pixels of a panel.
Image gallery(const std::vector<Exhibit>& exhibits, int columns, int width);

}  // namespace unsnarl::peers
