#include "sequence/hint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>
#include <vector>

#include "sequence/files.h"
#include "unsnarl/paths.h"

namespace unsnarl::app {
namespace {

constexpr std::size_t fewest_frames = 3;
constexpr std::size_t most_named = 4;  // of more, the first two and the last are in the command

bool has_number(const std::string& path) {
  const std::string name = path_of(path).stem().string();
  return std::any_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// The files with the faces of most files, in natural order.
std::vector<std::string> largest_group(const FixOptions& options, const SceneDocument& scene) {
  std::vector<std::pair<const Surface*, std::vector<std::string>>> groups;
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    if (!has_number(options.inputs[i])) continue;
    const Surface& faces = scene.document(i).surface();
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& known) {
      return known.first->positions.size() == faces.positions.size() && known.first->corners == faces.corners &&
             known.first->offsets == faces.offsets;
    });
    if (group == groups.end()) group = groups.insert(group, {&faces, {}});
    group->second.push_back(options.inputs[i]);
  }
  std::vector<std::string> largest;
  for (auto& [faces, paths] : groups)
    if (paths.size() > largest.size()) largest = std::move(paths);
  std::sort(largest.begin(), largest.end(), natural_order);
  return largest;
}

}  // namespace

std::string sequence_hint(const FixOptions& options, const SceneDocument& scene) {
  if (options.inputs.size() < fewest_frames || !options.nested.empty()) return {};
  const std::vector<std::string> frames = largest_group(options, scene);
  if (frames.size() < fewest_frames) return {};
  const std::string names = frames.size() <= most_named
                                ? fmt::format("{}", fmt::join(frames, " "))
                                : fmt::format("{} {} ... {}", frames[0], frames[1], frames.back());
  return fmt::format(
      "{} of these files have the same faces. If they are frames of a moving mesh, stop this command and repair them "
      "as "
      "a sequence, which is much faster: unsnarl fix --sequence {} -o {}",
      frames.size(), names, options.output);
}

}  // namespace unsnarl::app
