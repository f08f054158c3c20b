#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace unsnarl::app {

/// A mesh of a batch, or what stands for one: a line of a list that makes no sense, a folder that cannot be read.
struct BatchMesh {
  std::filesystem::path path;
  std::string name;          ///< its place below the folders of results: "a/b.obj"
  std::uintmax_t bytes = 0;  ///< size of the file; 0 where there is none
  std::string fault = {};    ///< why there is no work to do on it; empty: there is
};

/// Files of a folder that are no meshes, by their extension ("*.png").
struct OtherFiles {
  std::string first;  ///< the name of one of them
  std::size_t count = 0;
};

struct BatchInputs {
  std::vector<BatchMesh> meshes;  ///< sorted by name, those with faults too
  std::map<std::string, OtherFiles> others;
};

/// The meshes below a folder (hidden files and what a batch has written to `results` aside), or those that a list
/// names: a path a line, relative to the current folder, and after a tab the name of the result where it is to be
/// another; '-' reads the list from standard input. Throws FileError (also where there is nothing to do), SystemError,
/// UsageError.
BatchInputs batch_inputs(const std::string& list_or_folder, const std::filesystem::path& results);

/// Part `index` of `count`: the meshes index, index + count, ... in the order of their names.
struct Shard {
  std::size_t index = 0, count = 1;
  std::string name() const { return std::to_string(index) + "-of-" + std::to_string(count); }
};
/// "i/n", 0 <= i < n. Empty: the part of this task of a Slurm array (SLURM_ARRAY_TASK_ID, _COUNT, _MIN, _STEP), or all
/// outside of one. Throws UsageError.
Shard shard_from(const std::string& text);
std::vector<BatchMesh> part_of(const std::vector<BatchMesh>& meshes, const Shard& shard);

/// A path with some of its bytes as %41 and the like: text for any bytes.
std::string encoded_uri(const std::string& path);
std::string decoded_uri(const std::string& uri);

/// SHA-256 of the content of a mesh: its file, and the files that a glTF or a GIFTI keeps numbers in. Throws
/// SystemError.
std::string content_hash(const BatchMesh& mesh);

}  // namespace unsnarl::app
