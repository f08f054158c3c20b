#pragma once

#include <string_view>

namespace unsnarl::app {

/// The page that viewer/ builds, without data. Empty in a build without the viewer.
std::string_view viewer_template();

}  // namespace unsnarl::app
