#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/json_text.h"
#include "io/text_edits.h"
#include "unsnarl/document.h"

namespace unsnarl {

/// Places of the JSON and binary data in a GLB file (a .gltf file is all JSON).
struct GltfContainer {
  ByteRange json;
  std::optional<ByteRange> binary;

  static GltfContainer of_glb(std::string_view bytes);
  static GltfContainer of_gltf(std::string_view bytes) { return {{0, bytes.size()}, std::nullopt}; }

  /// The file with edited JSON (places count from the start of the JSON) and, where given, new binary data of the old
  /// size.
  std::string rebuilt(std::string_view bytes, std::vector<TextEdit> json_edits,
                      const std::optional<std::string>& new_binary) const;
};

/// The buffers of a glTF: in the file itself, in data: URIs, in files beside it.
class GltfBuffers {
 public:
  GltfBuffers() = default;
  /// `json` and `bytes` have to outlive this.
  GltfBuffers(const std::vector<JsonText::Value>& json, std::string_view bytes, const GltfContainer& container,
              const std::filesystem::path& folder);

  /// Number of the buffer that stands for all with the same bytes (files named twice). Throws FileError.
  std::size_t resolve(std::size_t buffer) const;
  /// Throws FileError where the buffer could not be read.
  std::string_view data(std::size_t buffer) const;

  /// All files to write: the main file with `json_edits` and the changed buffers, then the external buffers, whose
  /// names get the infix.
  std::vector<OutputFile> rebuilt(std::string_view bytes, const GltfContainer& container,
                                  std::vector<TextEdit> json_edits, std::map<std::size_t, std::string> changed,
                                  const std::string& infix) const;

 private:
  struct Buffer {
    enum class Kind : std::uint8_t { binary_chunk, data_uri, file } kind = Kind::file;
    std::size_t same_as = 0;  ///< the first buffer with the same file
    JsonText::Value uri;
    std::filesystem::path name;  ///< of a file
    std::string owned;           ///< data of a URI or file
    FileStamp stamp;             ///< of a file
    std::string_view view;       ///< data of the binary chunk
    std::string error;           ///< why there is no data
    int error_number = 0;        ///< the errno behind it; 0: there is none
  };
  void load(std::size_t i, const JsonText::Value& json, std::string_view bytes, const GltfContainer& container);
  std::vector<Buffer> buffers_;
};

}  // namespace unsnarl
