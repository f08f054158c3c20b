#include "io/gltf_container.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/base64.h"
#include "io/byte_order.h"
#include "io/linked_file.h"
#include "io/mesh_file.h"
#include "io/text_scanner.h"
#include "io/uri.h"

namespace unsnarl {
namespace {

constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
/// Size of the header of a GLB file (fixed by the format, in bytes)
constexpr std::size_t glb_header_size = 12;
/// Size of the header of a chunk (fixed by the format, in bytes)
constexpr std::size_t chunk_header_size = 8;

std::uint32_t word(std::string_view bytes, std::size_t at) {
  return load<std::uint32_t>(bytes.data() + at, std::endian::little);
}

/// A JSON string token for `text`, with '/' escaped where `old_token` does so.
std::string json_string(std::string_view text, std::string_view old_token) {
  const bool escape_slash = old_token.find("\\/") != std::string_view::npos;
  std::string result = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ') {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
      continue;
    }
    if (c == '"' || c == '\\' || (c == '/' && escape_slash)) result += '\\';
    result += c;
  }
  return result + '"';
}

/// The URI of the file with_infix(): its last part has the infix before the last dot, however that is written.
std::string uri_with_infix(const std::string& uri, std::string_view infix) {
  const std::string extension = named_path(percent_decoded(uri)).extension().string();
  // The URI of an extension has at least as many characters as the extension: go back until it is the same.
  for (std::size_t at = uri.size();; --at) {
    if (percent_decoded(std::string_view(uri).substr(at)) == extension)
      return uri.substr(0, at) + std::string(infix) + uri.substr(at);
    if (at == 0) return uri + std::string(infix);
  }
}

}  // namespace

GltfContainer GltfContainer::of_glb(std::string_view bytes) {
  if (bytes.empty()) throw FileError("the file is empty; a GLB file starts with 'glTF'");
  if (bytes.size() < glb_header_size + chunk_header_size || !bytes.starts_with("glTF")) {
    throw FileError("byte 0: 'glTF' and a header of 12 bytes should be here; check that it is a GLB file");
  }
  if (word(bytes, 4) != 2) {
    throw FileError(
        fmt::format("byte 4: glTF version {}, but only version 2 is supported; convert the file", word(bytes, 4)));
  }
  const std::size_t length = word(bytes, 8);
  if (length > bytes.size()) {
    throw FileError(fmt::format("byte 8: the header promises {} bytes, but the file has {}; it is cut short", length,
                                bytes.size()));
  }
  GltfContainer result;
  bool has_json = false;
  for (std::size_t at = glb_header_size; at + chunk_header_size <= length;) {
    const std::size_t size = word(bytes, at);
    const std::uint32_t type = word(bytes, at + 4);
    if (size > length - at - chunk_header_size) {
      throw FileError(
          fmt::format("byte {}: a chunk of {} bytes reaches beyond the end of the file; it is cut short", at, size));
    }
    const ByteRange range{at + chunk_header_size, size};
    if (!has_json) {
      if (type != json_chunk)
        throw FileError(fmt::format("byte {}: the first chunk should be JSON; the file is damaged", at));
      has_json = true;
      result.json = range;
    } else if (type == binary_chunk && !result.binary) {
      result.binary = range;
    }
    at += chunk_header_size + size;
  }
  if (!has_json) throw FileError("the file holds no JSON chunk; it is cut short");
  return result;
}

std::string GltfContainer::rebuilt(std::string_view bytes, std::vector<TextEdit> json_edits,
                                   const std::optional<std::string>& new_binary) const {
  std::string result(bytes);
  if (new_binary) result.replace(binary->begin, binary->size, *new_binary);
  if (json_edits.empty()) return result;
  std::string text = with_edits(bytes.substr(json.begin, json.size), std::move(json_edits));
  const bool is_glb = json.begin > 0;
  if (is_glb) {
    // Chunks are padded with spaces to whole words.
    while (text.ends_with(' ')) text.pop_back();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto size = static_cast<std::uint32_t>(text.size());
    const auto total = static_cast<std::uint32_t>(word(bytes, 8) + text.size() - json.size);
    store(result.data() + 8, total, std::endian::little);
    store(result.data() + json.begin - chunk_header_size, size, std::endian::little);
  }
  result.replace(json.begin, json.size, text);
  return result;
}

GltfBuffers::GltfBuffers(const std::vector<JsonText::Value>& json, std::string_view bytes,
                         const GltfContainer& container, const std::filesystem::path& folder) {
  buffers_.resize(json.size());
  std::map<std::filesystem::path, std::size_t> known;
  for (std::size_t i = 0; i < json.size(); ++i) {
    load(i, json[i], bytes, container);
    Buffer& buffer = buffers_[i];
    buffer.same_as = i;
    if (buffer.kind == Buffer::Kind::file && buffer.error.empty()) {
      buffer.same_as = known.try_emplace(buffer.name, i).first->second;
      if (buffer.same_as != i) continue;
      try {
        FileRead file = read_stamped_file(linked_file(folder, buffer.name));
        buffer.owned = std::move(file.bytes);
        buffer.stamp = file.stamp;
      } catch (const FileError& error) {
        buffer.error = fmt::format("buffer {}: {}", i, error.what());
        buffer.error_number = error.error_number();
      }
    }
  }
  for (std::size_t i = 0; i < json.size(); ++i) {
    Buffer& buffer = buffers_[i];
    const std::optional<std::size_t> length = json[i]["byteLength"].index();
    Buffer& source = buffers_[buffer.same_as];
    const std::size_t size = source.kind == Buffer::Kind::binary_chunk ? source.view.size() : source.owned.size();
    if (source.error.empty() && (!length || *length > size)) {
      source.error = fmt::format("buffer {} should have {} bytes, but {} are there; the file is cut short or damaged",
                                 i, length ? fmt::to_string(*length) : "some", size);
    }
  }
}

void GltfBuffers::load(std::size_t i, const JsonText::Value& json, std::string_view bytes,
                       const GltfContainer& container) {
  Buffer& buffer = buffers_[i];
  buffer.uri = json["uri"];
  if (!buffer.uri) {
    buffer.kind = Buffer::Kind::binary_chunk;
    if (i == 0 && container.binary) {
      buffer.view = bytes.substr(container.binary->begin, container.binary->size);
    } else {
      buffer.error = fmt::format(
          "buffer {} has no uri and no binary chunk; its data is missing (geometry compressed by an "
          "extension is not supported)",
          i);
    }
    return;
  }
  const std::string uri = buffer.uri.string();
  if (uri.starts_with("data:")) {
    buffer.kind = Buffer::Kind::data_uri;
    const std::size_t start = data_uri_start(uri);
    std::optional<std::string> decoded;
    if (start != std::string::npos) decoded = base64_decoded(std::string_view(uri).substr(start));
    if (decoded) {
      buffer.owned = std::move(*decoded);
    } else {
      buffer.error = fmt::format("buffer {}: the data: URI is not valid base64; the file is damaged", i);
    }
    return;
  }
  buffer.name = named_path(percent_decoded(uri)).lexically_normal();
  if (uri.find("://") != std::string::npos)
    buffer.error =
        fmt::format("buffer {}: {} is not a file in the folder of the glTF file; put it there", i, in_quotes(uri));
}

std::size_t GltfBuffers::resolve(std::size_t buffer) const {
  if (buffer >= buffers_.size()) {
    throw FileError(
        fmt::format("buffer {} is used, but the file has {} buffers; it is damaged", buffer, buffers_.size()));
  }
  return buffers_[buffer].same_as;
}

std::string_view GltfBuffers::data(std::size_t i) const {
  const Buffer& buffer = buffers_[i];
  if (!buffer.error.empty()) throw FileError(buffer.error, buffer.error_number);
  return buffer.kind == Buffer::Kind::binary_chunk ? buffer.view : std::string_view(buffer.owned);
}

std::vector<OutputFile> GltfBuffers::rebuilt(std::string_view bytes, const GltfContainer& container,
                                             std::vector<TextEdit> json_edits,
                                             std::map<std::size_t, std::string> changed,
                                             const std::string& infix) const {
  std::vector<OutputFile> files(1);
  std::optional<std::string> binary;
  for (std::size_t i = 0; i < buffers_.size(); ++i) {
    const Buffer& buffer = buffers_[i];
    const auto change = changed.find(i);
    const bool is_changed = change != changed.end();
    if (buffer.kind == Buffer::Kind::binary_chunk && is_changed) {
      binary = std::move(change->second);
    } else if (buffer.kind == Buffer::Kind::data_uri && is_changed) {
      std::string uri = buffer.uri.string();
      const std::size_t start = data_uri_start(uri);
      std::string encoded = uri.substr(start);
      base64_patch(encoded, buffer.owned, change->second);
      json_edits.push_back(
          {buffer.uri.begin(), buffer.uri.end(), json_string(uri.substr(0, start) + encoded, buffer.uri.text())});
    } else if (buffer.kind == Buffer::Kind::file && buffers_[buffer.same_as].error.empty()) {
      const std::string uri = uri_with_infix(buffer.uri.string(), infix);
      if (!infix.empty())
        json_edits.push_back({buffer.uri.begin(), buffer.uri.end(), json_string(uri, buffer.uri.text())});
      if (buffer.same_as == i)
        files.push_back(
            {with_infix(buffer.name, infix), is_changed ? std::move(change->second) : buffer.owned, buffer.stamp});
    }
  }
  files[0].bytes = container.rebuilt(bytes, std::move(json_edits), binary);
  return files;
}

}  // namespace unsnarl
