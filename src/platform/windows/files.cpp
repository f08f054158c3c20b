#include "platform/files.h"

#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cwctype>
#include <random>
#include <system_error>

#include "platform/windows/system.h"

namespace unsnarl::platform {
namespace {

namespace fs = std::filesystem;

constexpr DWORD all_may_share = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
/// One call writes this many bytes at most (unit: bytes)
constexpr std::size_t largest_piece = std::size_t{1} << 30;

/// Opens what is there, folders too.
Handle opened(const fs::path& path, DWORD access) {
  return owned(
      ::CreateFileW(path.c_str(), access, all_may_share, nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
}

FileStatus status_of_handle(HANDLE handle) {
  constexpr std::int64_t ticks_a_second = 10'000'000;  ///< Of a FILETIME, 100 ns each (fixed by Windows)
  BY_HANDLE_FILE_INFORMATION information;
  if (::GetFileType(handle) != FILE_TYPE_DISK || !::GetFileInformationByHandle(handle, &information))
    return {FileKind::other, {}};
  const auto joined = [](DWORD high, DWORD low) { return static_cast<std::uint64_t>(high) << 32 | low; };
  const auto ticks = static_cast<std::int64_t>(
      joined(information.ftLastWriteTime.dwHighDateTime, information.ftLastWriteTime.dwLowDateTime));
  const bool is_folder = (information.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  return {is_folder ? FileKind::folder : FileKind::file,
          {information.dwVolumeSerialNumber, joined(information.nFileIndexHigh, information.nFileIndexLow),
           static_cast<std::int64_t>(joined(information.nFileSizeHigh, information.nFileSizeLow)),
           ticks / ticks_a_second, ticks % ticks_a_second * 100}};
}

bool write_all(HANDLE handle, std::string_view bytes) {
  while (!bytes.empty()) {
    DWORD written = 0;
    const auto count = static_cast<DWORD>(std::min(bytes.size(), largest_piece));
    if (!::WriteFile(handle, bytes.data(), count, &written, nullptr)) return false;
    bytes.remove_prefix(written);
  }
  return true;
}

int error_of(BOOL has_succeeded) {
  return has_succeeded ? 0 : last_errno();
}

bool is_wild(const std::wstring& part) {
  return part.find_first_of(L"*?[") != part.npos;
}

/// Is the character one of a set "[...]" that begins behind `at`? Moves `at` to the end of the set; of one that has no
/// end, npos.
bool is_in_set(const std::wstring& pattern, std::size_t& at, wchar_t c) {
  const std::size_t begin = at + 1;
  const bool is_negated = begin < pattern.size() && pattern[begin] == L'!';
  const std::size_t first = begin + (is_negated ? 1 : 0);
  at = pattern.find(L']', first + 1);
  bool is_in = false;
  for (std::size_t k = first; at != pattern.npos && k < at; ++k) {
    const bool is_range = k + 2 < at && pattern[k + 1] == L'-';
    is_in |= is_range ? pattern[k] <= c && c <= pattern[k + 2] : pattern[k] == c;
    if (is_range) k += 2;
  }
  return is_in != is_negated;
}

/// Does the name from n on match the pattern from p on? Both are in lower case.
bool matches(const std::wstring& pattern, std::size_t p, const std::wstring& name, std::size_t n) {
  for (; p < pattern.size(); ++p, ++n) {
    if (pattern[p] == L'*') {
      for (std::size_t end = n; end <= name.size(); ++end)
        if (matches(pattern, p + 1, name, end)) return true;
      return false;
    }
    if (n >= name.size()) return false;
    if (pattern[p] == L'[' && pattern.find(L']', p + 2) != pattern.npos) {
      if (!is_in_set(pattern, p, name[n])) return false;
    } else if (pattern[p] != L'?' && pattern[p] != name[n]) {
      return false;
    }
  }
  return n == name.size();
}

std::wstring lower(std::wstring text) {
  std::transform(text.begin(), text.end(), text.begin(), [](wchar_t c) { return std::towlower(c); });
  return text;
}

/// The names in a folder that a part of a pattern stands for, sorted; hidden ones (".") it must name.
int list_matches(const fs::path& folder, const std::wstring& part, std::vector<fs::path>& names) {
  const std::wstring pattern = lower(part);
  std::error_code error;
  for (fs::directory_iterator it(folder.empty() ? L"." : folder, error), end; !error && it != end;
       it.increment(error)) {
    const std::wstring name = it->path().filename().wstring();
    if ((name.starts_with(L'.') && !part.starts_with(L'.')) || !matches(pattern, 0, lower(name), 0)) continue;
    names.emplace_back(name);
  }
  std::sort(names.begin(), names.end());
  return error ? errno_of(error) : 0;
}

}  // namespace

FileStatus status_of(const fs::path& path) {
  const Handle file = opened(path, FILE_READ_ATTRIBUTES);
  return file ? status_of_handle(file.get()) : FileStatus();
}

InputFile::InputFile(const fs::path& path, Opening) {
  Handle file = opened(path, GENERIC_READ);
  if (!file) error_ = last_errno();
  if (error_ == 0) descriptor_ = ::_open_osfhandle(reinterpret_cast<intptr_t>(file.get()), _O_RDONLY | _O_BINARY);
  if (descriptor_ < 0) error_ = errno;
  is_owned_ = error_ == 0;
  if (is_owned_) file.release();  // the descriptor's now
}

InputFile::~InputFile() {
  if (is_owned_) ::_close(descriptor_);
}

FileStatus InputFile::status() {
  return status_of_handle(reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor_)));
}

std::size_t InputFile::read(char* bytes, std::size_t size) {
  const int got = ::_read(descriptor_, bytes, static_cast<unsigned>(std::min(size, largest_piece)));
  error_ = got < 0 ? errno : 0;
  return got < 0 ? 0 : static_cast<std::size_t>(got);
}

int write_new_file(const fs::path& path, std::string_view bytes) {
  const Handle file =
      owned(::CreateFileW(path.c_str(), GENERIC_WRITE, 0, nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr));
  return error_of(file && write_all(file.get(), bytes) && ::FlushFileBuffers(file.get()));
}

int write_to_device(const fs::path& path, std::string_view bytes) {
  const Handle file = opened(path, GENERIC_WRITE);
  return error_of(file && write_all(file.get(), bytes));
}

int why_not_writable(const fs::path& file) {
  return error_of(opened(file, GENERIC_WRITE) != nullptr);
}

int why_not_writable_folder(const fs::path& folder) {
  return error_of(opened(folder, FILE_ADD_FILE) != nullptr);
}

/// A mounted folder is no file.
bool is_mount_point(const fs::path&) {
  return false;
}

/// A new file has what its folder hands down; the attributes are the file's own.
void copy_permissions(const fs::path& from, const fs::path& to) {
  constexpr DWORD copied = FILE_ATTRIBUTE_HIDDEN | FILE_ATTRIBUTE_SYSTEM | FILE_ATTRIBUTE_NOT_CONTENT_INDEXED;
  const DWORD old = ::GetFileAttributesW(from.c_str());
  if (old != INVALID_FILE_ATTRIBUTES && (old & copied) != 0) ::SetFileAttributesW(to.c_str(), old & copied);
}

int move_file(const fs::path& from, const fs::path& to) {
  return error_of(::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH));
}

int give_second_name(const fs::path& file, const fs::path& name) {
  return error_of(::CreateHardLinkW(name.c_str(), file.c_str(), nullptr));
}

int remove_file(const fs::path& file) {
  return error_of(::DeleteFileW(file.c_str()));
}

int make_folder(const fs::path& folder) {
  return error_of(::CreateDirectoryW(folder.c_str(), nullptr));
}

int remove_folder(const fs::path& folder) {
  return error_of(::RemoveDirectoryW(folder.c_str()));
}

/// move_file() returns when the move is on the disk.
void flush_folder(const fs::path&) {}

int make_temporary_folder(const fs::path& parent, const std::string& prefix, fs::path& made) {
  constexpr std::wstring_view characters = L"abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  int error = EEXIST;
  for (int attempt = 0; attempt < 100 && error == EEXIST; ++attempt) {
    std::wstring name = utf16_of(prefix);
    for (int k = 0; k < 6; ++k) name += characters[random() % characters.size()];
    made = parent / name;
    error = make_folder(made);
  }
  return error;
}

int find_matches(const std::string& pattern, bool (*is_failure)(int error_number), std::vector<std::string>& paths) {
  const fs::path whole(utf16_of(pattern));
  std::vector<fs::path> found = {whole.root_path()};
  for (const fs::path& part : whole.relative_path()) {
    std::vector<fs::path> longer;
    for (const fs::path& folder : found) {
      std::vector<fs::path> names;
      int error = 0;
      if (is_wild(part.wstring()))
        error = list_matches(folder, part.wstring(), names);
      else if (status_of(folder / part).kind != FileKind::none)
        names.push_back(part);
      if (error != 0 && is_failure(error)) return error;
      for (const fs::path& name : names) longer.push_back(folder / name);
    }
    found = std::move(longer);
  }
  for (const fs::path& path : found) paths.push_back(utf8_of(path.wstring()));
  return 0;
}

}  // namespace unsnarl::platform
