#pragma once

#include <string>

#include "fix.h"
#include "unsnarl/scene_document.h"

namespace unsnarl::app {

/// What to say where the files of a scene look like the frames of one moving mesh, which are repaired against each other
/// at a great cost: at least three have the same faces and a number in their names. Else empty.
std::string sequence_hint(const FixOptions& options, const SceneDocument& scene);

}  // namespace unsnarl::app
