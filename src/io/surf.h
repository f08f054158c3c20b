#pragma once

#include <string_view>

namespace unsnarl {

/// Do these bytes start a FreeSurfer surface? Its files often have no extension that would tell.
bool is_freesurfer_surface(std::string_view bytes);

}  // namespace unsnarl
