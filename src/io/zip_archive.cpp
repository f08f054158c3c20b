#include "io/zip_archive.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "unsnarl/document.h"

namespace unsnarl {

struct ZipDiscard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_source_t* source) const { zip_source_free(source); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using ZipHandle = std::unique_ptr<zip_t, ZipDiscard>;
using ZipSource = std::unique_ptr<zip_source_t, ZipDiscard>;

namespace {

/// Deflate makes nothing smaller than this; zlib's Technical Details, "Maximum Compression Factor" (fixed by deflate)
constexpr std::uint64_t largest_ratio = 1032;
/// An entry that unpacks to at most this many bytes is unpacked whatever its ratio (unit: bytes)
constexpr std::uint64_t harmless_size = 64'000'000;
/// A larger entry that unpacks to more than this many times its size is made to fill the memory: models shrink to a
/// third to a twentieth (no unit)
constexpr std::uint64_t largest_honest_ratio = 200;
/// Level of compression, zlib's default: higher levels take much longer for little less room (unit: zlib levels, 0 to
/// 9)
constexpr zip_uint32_t level = 6;

class Error {
 public:
  Error() { zip_error_init(&error_); }
  Error(const Error&) = delete;
  Error& operator=(const Error&) = delete;
  ~Error() { zip_error_fini(&error_); }
  zip_error_t* get() { return &error_; }
  std::string text() { return zip_error_strerror(&error_); }

 private:
  zip_error_t error_{};
};

/// An archive over `bytes`, and its source, which stays usable after the archive is closed. One that is to be written
/// gets a copy, since libzip 1.7 frees the unchanged part at the front of a written buffer, whosever it is.
std::pair<ZipHandle, ZipSource> opened(std::string_view bytes, bool is_written) {
  Error error;
  const char* data = bytes.data();
  if (is_written) {
    auto* copy = static_cast<char*>(std::malloc(bytes.size()));
    if (copy == nullptr) throw std::bad_alloc();
    std::copy(bytes.begin(), bytes.end(), copy);
    data = copy;
  }
  ZipSource source(zip_source_buffer_create(data, bytes.size(), is_written ? 1 : 0, error.get()));
  if (!source) throw std::bad_alloc();
  zip_source_keep(source.get());
  ZipHandle archive(zip_open_from_source(source.get(), is_written ? 0 : ZIP_RDONLY, error.get()));
  if (!archive) {
    zip_source_free(source.get());
    throw FileError(fmt::format("this is not a ZIP archive ({}); the file is cut short, damaged or of another format",
                                error.text()));
  }
  return {std::move(archive), std::move(source)};
}

/// Negative: there is none.
zip_int64_t entry_of(zip_t* archive, const std::string& name) {
  return zip_name_locate(archive, name.c_str(), ZIP_FL_NOCASE | ZIP_FL_ENC_GUESS);
}

void check(bool is_good, zip_t* archive) {
  if (!is_good) throw WriteError(fmt::format("the archive cannot be written: {}", zip_strerror(archive)));
}

/// `content` has to outlive the archive.
void replace_entry(zip_t* archive, const std::string& name, const std::string& content) {
  const zip_int64_t found = entry_of(archive, name);
  if (found < 0) throw std::invalid_argument("no entry " + name);
  const auto entry = static_cast<zip_uint64_t>(found);
  zip_stat_t status{};
  check(zip_stat_index(archive, entry, 0, &status) == 0, archive);
  zip_source_t* replacement = zip_source_buffer(archive, content.data(), content.size(), 0);
  if (replacement == nullptr) throw std::bad_alloc();
  if (zip_file_replace(archive, entry, replacement, 0) < 0) {
    zip_source_free(replacement);
    check(false, archive);
  }
  // The level counts only where the method is another; "default" is, and means deflate.
  const zip_int32_t method = status.comp_method == ZIP_CM_DEFLATE ? ZIP_CM_DEFAULT : status.comp_method;
  check(zip_set_file_compression(archive, entry, method, level) == 0, archive);
  check(zip_file_set_mtime(archive, entry, status.mtime, 0) == 0, archive);
}

}  // namespace

struct ZipArchive::Handle {
  ZipHandle archive;
  ZipSource source;
};

ZipArchive::ZipArchive(std::string_view bytes) : bytes_(bytes), handle_(std::make_unique<Handle>()) {
  auto [archive, source] = opened(bytes, false);
  handle_->source = std::move(source);
  handle_->archive = std::move(archive);
}
ZipArchive::~ZipArchive() {
  handle_->archive.reset();
}

std::optional<std::string> ZipArchive::content(const std::string& name) const {
  zip_t* archive = handle_->archive.get();
  const zip_int64_t entry = entry_of(archive, name);
  if (entry < 0) return std::nullopt;
  zip_stat_t status{};
  const auto fail = [&](const std::string& why) {
    throw FileError(fmt::format("'{}' of the archive cannot be read: {}", name, why));
  };
  if (zip_stat_index(archive, static_cast<zip_uint64_t>(entry), 0, &status) < 0) fail(zip_strerror(archive));
  if (status.comp_size > bytes_.size() || status.size / largest_ratio > status.comp_size)
    fail("its size makes no sense; the file is damaged");
  if (status.size > harmless_size && status.size / largest_honest_ratio > status.comp_size)
    fail(
        fmt::format("it would unpack to {} MB, {} times its size, as no model does; pack it anew without what fills it",
                    status.size / 1'000'000, status.size / std::max<std::uint64_t>(1, status.comp_size)));
  const std::unique_ptr<zip_file_t, ZipDiscard> file(zip_fopen_index(archive, static_cast<zip_uint64_t>(entry), 0));
  if (!file) fail(zip_strerror(archive));
  std::string result(status.size, '\0');
  std::size_t done = 0;
  while (done < result.size()) {
    const zip_int64_t got = zip_fread(file.get(), result.data() + done, result.size() - done);
    if (got <= 0) fail(got < 0 ? zip_file_strerror(file.get()) : "it ends too early; the file is damaged");
    done += static_cast<std::size_t>(got);
  }
  char more = 0;  // reading on to the end compares the checksum
  if (zip_fread(file.get(), &more, 1) != 0) fail("it is damaged");
  return result;
}

std::string ZipArchive::with_contents(const std::map<std::string, std::string>& contents) const {
  auto [archive, source] = opened(bytes_, true);
  for (const auto& [name, content] : contents) replace_entry(archive.get(), name, content);
  check(zip_close(archive.get()) == 0, archive.get());
  static_cast<void>(archive.release());  // closed, so freed

  zip_stat_t status{};
  if (zip_source_stat(source.get(), &status) < 0 || zip_source_open(source.get()) < 0)
    throw WriteError("the archive cannot be read back");
  std::string result(status.size, '\0');
  const zip_int64_t got = zip_source_read(source.get(), result.data(), result.size());
  zip_source_close(source.get());
  if (got != static_cast<zip_int64_t>(result.size())) throw WriteError("the archive cannot be read back");
  return result;
}

}  // namespace unsnarl
