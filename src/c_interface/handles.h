// What the opaque handles of unsnarl.h stand for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "unsnarl/repair.h"
#include "unsnarl/repair_file_steps.h"
#include "unsnarl/scene_document.h"
#include "unsnarl/unsnarl.h"

struct unsnarl_context {
  unsnarl::Context context;
};

struct unsnarl_document {
  std::vector<std::filesystem::path> paths;
  std::shared_ptr<unsnarl::SceneDocument> scene;  // of one file or several
  std::vector<std::size_t> mesh_sizes;            // as unsnarl_surface has them; empty: it is one
  std::string report;
  std::vector<std::string> partial;  // places of unsnarl_document_write_partial, one a file; empty: nothing was written
};

struct unsnarl_result {
  struct Array {
    std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::uint8_t>> values;
    std::size_t columns = 1;
  };

  std::string status, report;
  std::map<std::string, Array, std::less<>> arrays;
  /// Of a repair: what files with its positions, which are among the arrays, are certified for.
  struct Repaired {
    unsnarl::RepairResult result;
    unsnarl::RepairFileOptions options;
  };
  std::optional<Repaired> repaired;
};
