#pragma once

#include <filesystem>
#include <string>

namespace unsnarl {

// What a file names, its buffers, images, materials and arrays, is read by one rule: it lies in the folder of that file
// or below, by its name and once symbolic links are followed. A mesh from elsewhere could have any other file of ours
// copied beside its result, or put into a page.

/// The path that a file names: its parts may have \ between them as well as /, since exporters write what their own
/// system does.
std::filesystem::path named_path(std::string text);

/// The place of the file `name` that a file in `folder` names. Throws FileError unless the rule allows it; whether it
/// is there is for its reader to say.
std::filesystem::path linked_file(const std::filesystem::path& folder, const std::filesystem::path& name);

}  // namespace unsnarl
