#pragma once

#include <string_view>

namespace unsnarl::app {

/// The page of a batch, without data (page.html).
std::string_view batch_page_template();

}  // namespace unsnarl::app
