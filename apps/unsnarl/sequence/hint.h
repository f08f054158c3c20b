#pragma once

#include <string>

#include "fix.h"
#include "unsnarl/scene_document.h"

namespace unsnarl::app {

/// A note that the files of a scene look like frames of one moving mesh: at least three have the same faces and a
/// number in their names. As a scene they are separated from each other, at a great cost. Empty: they do not look so.
std::string sequence_hint(const FixOptions& options, const SceneDocument& scene);

}  // namespace unsnarl::app
