#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "unsnarl/repair.h"

namespace unsnarl::app {

/// What is to be looked at.
struct PageSource {
  std::string input_name, output_name;  ///< output_name may be empty
  SurfaceView before;
  std::span<const double> after;  ///< empty: there is only one surface to look at
  FindOptions find;
  Goal goal = Goal::all;                  ///< which pairs are shown
  nlohmann::ordered_json report;          ///< null: none
  std::span<const RecordedFrame> frames;  ///< of the repair; may be empty
};

/// The name of a mesh as the page shows it: the last part of its path.
std::string page_name(const std::string& path);

/// Throws UsageError where this build has no viewer.
void require_viewer();
/// The page as one HTML file. Throws UsageError as above.
std::string view_page(const PageSource& source);

}  // namespace unsnarl::app
