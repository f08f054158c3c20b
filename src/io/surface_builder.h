#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_file.h"

namespace unsnarl {

/// Collects faces into a Surface: no offsets as long as all of them are triangles.
class FaceCollector {
 public:
  explicit FaceCollector(Surface& surface) : surface_(surface) {}

  /// Adds a face; one with fewer than 3 corners is only counted. False: 32-bit offsets are exhausted.
  bool add(std::span<const std::int32_t> face) {
    if (face.size() < 3) {
      ++ignored_;
      return true;
    }
    std::vector<std::int32_t>& corners = surface_.corners;
    std::vector<std::int32_t>& offsets = surface_.offsets;
    if (corners.size() + face.size() > std::numeric_limits<std::int32_t>::max()) return false;
    if (face.size() != 3 && offsets.empty()) {
      offsets.reserve(corners.size() / 3 + 2);
      for (std::size_t i = 0; i <= corners.size(); i += 3) offsets.push_back(static_cast<std::int32_t>(i));
    }
    corners.insert(corners.end(), face.begin(), face.end());
    if (!offsets.empty()) offsets.push_back(static_cast<std::int32_t>(corners.size()));
    ++count_;
    return true;
  }
  std::size_t count() const { return count_; }

  void note_ignored(std::vector<std::string>& notes) const;

 private:
  Surface& surface_;
  std::size_t count_ = 0;
  std::size_t ignored_ = 0;
};

/// Collects the names of one kind, face by face.
class LabelCollector {
 public:
  explicit LabelCollector(std::string kind) { labels_.kind = std::move(kind); }

  /// Faces from number `from_face` on bear this name.
  void start(std::string_view name, std::size_t from_face) {
    fill(from_face);
    const auto [entry, is_new] = ids_.try_emplace(std::string(name), static_cast<std::int32_t>(labels_.names.size()));
    if (is_new) labels_.names.push_back(entry->first);
    current_ = entry->second;
  }
  void stop(std::size_t from_face) {
    fill(from_face);
    current_ = -1;
  }
  /// Appends to `all` unless no name was ever given.
  void finish(std::size_t face_count, std::vector<FaceLabels>& all) {
    fill(face_count);
    if (!labels_.names.empty()) all.push_back(std::move(labels_));
  }

 private:
  void fill(std::size_t face_count) {
    if (labels_.of_face.size() < face_count) labels_.of_face.resize(face_count, current_);
  }
  FaceLabels labels_;
  std::map<std::string, std::int32_t, std::less<>> ids_;
  std::int32_t current_ = -1;
};

}  // namespace unsnarl
