#include "unsnarl/staged_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>

#include "io/mesh_file.h"
#include "platform/files.h"

namespace unsnarl {
namespace {

namespace fs = std::filesystem;

/// In a temporary folder: the new files, and the old ones while they are being replaced, each under its name.
constexpr const char *new_folder = "new", *old_folder = "old";

fs::path with_links_followed(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::weakly_canonical(path, error);
  if (error) throw_write_error(path.string() + ": cannot follow the link", platform::errno_of(error));
  return target;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void require_replaceable(const fs::path& target) {
  const platform::FileKind kind = platform::status_of(target).kind;
  if (kind == platform::FileKind::none) return;
  if (kind == platform::FileKind::folder)
    throw WriteError(fmt::format("{}: is a folder; name a file in it", target.string()), EISDIR);
  if (kind != platform::FileKind::file) throw WriteError(fmt::format("{}: is not a regular file", target.string()));
  // Renaming would get past the protection of the old file.
  if (const int reason = platform::why_not_writable(target); reason != 0)
    throw_write_error(target.string() + ": is write-protected", reason);
  if (platform::is_mount_point(target))
    throw WriteError(
        fmt::format("{}: is a mount point, which no other file can take the place of; name another file, or mount its "
                    "folder instead",
                    target.string()));
}

/// The innermost folder on the way to this place that is there.
fs::path existing_folder_of(const fs::path& place) {
  std::error_code ignored;
  fs::path folder = folder_of(place);
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder_of(folder);
  return folder;
}

bool leads_into(const fs::path& folder, const fs::path& place) {
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error) return false;
  const fs::path real = fs::canonical(place, error);
  return !error && std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
}

bool has_hidden_part(const fs::path& name) {
  return std::any_of(name.begin(), name.end(), [](const fs::path& part) { return part.string().starts_with('.'); });
}

/// `name`: of a file that belongs to the main one at `target`. It may come from a file that somebody else made.
void require_place_beside(const fs::path& target, const fs::path& name) {
  const fs::path place = folder_of(target) / name;
  std::error_code ignored;
  if (!is_inside_folder(name) || (has_hidden_part(name) && !has_hidden_part(target.filename())))
    throw WriteError(
        fmt::format("{}: a file of this name is not written: its name was given by the input, and is hidden or leads "
                    "out of the folder of the result; rename it there",
                    place.string()));
  const fs::path folder = existing_folder_of(place);
  if (!fs::is_directory(folder, ignored))
    throw WriteError(fmt::format("{}: {} is not a folder", place.string(), folder.string()));
  if (!leads_into(folder_of(target), folder))
    throw WriteError(fmt::format("{}: {} leads out of the folder of the result; write to another folder",
                                 place.string(), folder.string()));
  if (const int reason = platform::why_not_writable_folder(folder); reason != 0)
    throw_write_error(fmt::format("{}: cannot create files in the folder {}", place.string(), folder.string()), reason);
  require_replaceable(place);
}

}  // namespace

bool can_be_replaced(const fs::path& place) {
  try {
    require_replaceable(place);
    return true;
  } catch (const WriteError&) {
    return false;
  }
}

/// Moves that can be taken back. Once it is made it allocates nothing, so that lack of memory cannot stop it half way.
class StagedFiles::Moves {
 public:
  explicit Moves(const std::vector<File>& files) : files_(files), states_(files.size(), State::untouched) {
    for (const File& file : files) find_missing_folders(folder_of(file.target));
  }

  /// Where the old file has a name in the temporary folder too, moving the new one over it is one step, before and
  /// after which there is a whole file; some file systems have no second names.
  bool put_aside(std::size_t i) {
    const File& file = files_[i];
    failed_ = i;
    int reason = platform::give_second_name(file.target, file.old);
    const auto is_missing = [&] { return reason == ENOENT || reason == ENOTDIR; };
    if (reason != 0 && !is_missing()) reason = platform::move_file(file.target, file.old);
    if (is_missing()) return true;
    const bool is_aside = has_succeeded(reason);
    if (is_aside) states_[i] = State::put_aside;
    return is_aside;
  }
  bool make_folders() {
    for (; made_ < missing_.size(); ++made_)
      if (const int reason = platform::make_folder(missing_[made_]); reason != EEXIST && !has_succeeded(reason))
        return false;
    return true;
  }
  bool replace(std::size_t i) {
    failed_ = i;
    if (!has_succeeded(platform::move_file(files_[i].staged, files_[i].target))) return false;
    states_[i] = states_[i] == State::put_aside ? State::replaced : State::made;
    return true;
  }
  /// False: not all is as it was; the old files that are not back are in the temporary folders.
  bool take_back() {
    bool all = true;
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (states_[i] == State::made) all &= platform::remove_file(files_[i].target) == 0;
      if (states_[i] == State::put_aside || states_[i] == State::replaced) all &= put_back(files_[i]);
    }
    while (made_ > 0) platform::remove_folder(missing_[--made_]);
    return all;
  }
  /// The file that the last step was about.
  const fs::path& failed() const { return files_[failed_].target; }
  /// The errno of its failure.
  int reason() const { return reason_; }

 private:
  enum class State : std::uint8_t { untouched, put_aside, replaced, made };

  bool has_succeeded(int reason) {
    if (reason != 0) reason_ = reason;
    return reason == 0;
  }
  static bool put_back(const File& file) {
    if (platform::move_file(file.old, file.target) == 0) return true;
    platform::remove_file(file.target);
    return platform::give_second_name(file.old, file.target) == 0;
  }
  void find_missing_folders(const fs::path& folder) {
    std::error_code ignored;
    if (fs::exists(folder, ignored) || !folder.has_relative_path()) return;
    find_missing_folders(folder_of(folder));
    if (std::find(missing_.begin(), missing_.end(), folder) == missing_.end()) missing_.push_back(folder);
  }

  const std::vector<File>& files_;
  std::vector<State> states_;
  std::vector<fs::path> missing_;  // folders, the outermost first
  std::size_t made_ = 0;           // of these
  std::size_t failed_ = 0;
  int reason_ = 0;
};

StagedFiles::StagedFiles(Guard guard) : guard_(std::move(guard)), reserve_(new char[reserve_size]) {}

StagedFiles::~StagedFiles() {
  reserve_.reset();
  guarded([this] { remove_folders(); });
}

void StagedFiles::guarded(const std::function<void()>& step) const {
  if (guard_) return guard_(*this, step);
  step();
}

void StagedFiles::remove_folders() {
  std::error_code ignored;
  for (const fs::path& folder : folders()) {
    fs::remove_all(folder, ignored);
    if (ignored) remove_known_files(folder);
  }
  folders_.clear();
}

/// Without listing folders, for which there may be no descriptor left.
void StagedFiles::remove_known_files(const fs::path& staging) const {
  for (const File& file : files_) {
    platform::remove_file(file.staged);
    platform::remove_file(file.old);
  }
  for (const fs::path& folder : {staging / new_folder, staging / old_folder, staging}) platform::remove_folder(folder);
}

void StagedFiles::open(const fs::path& target, Links links) {
  const fs::path place = links == Links::followed ? with_links_followed(target) : target;
  require_replaceable(place);
  const fs::path folder = folder_of(place);
  if (!folders_.contains(folder)) guarded([&] { make_folder(target, folder); });
}

void StagedFiles::make_folder(const fs::path& target, const fs::path& folder) {
  const auto entry = folders_.emplace(folder, fs::path()).first;
  if (const int reason = platform::make_temporary_folder(folder, ".unsnarl-", entry->second); reason != 0) {
    folders_.erase(entry);
    throw_write_error(fmt::format("{}: cannot create files in the folder {}", target.string(), folder.string()),
                      reason);
  }
}

void StagedFiles::open_beside(const fs::path& target, const std::vector<fs::path>& names) {
  open(target);
  for (const fs::path& name : names) require_place_beside(with_links_followed(target), name);
}

fs::path StagedFiles::staging_of(const fs::path& target) const {
  return folders_.at(folder_of(target));
}

fs::path StagedFiles::add(const fs::path& target, std::string_view bytes) {
  return add(target, {{{}, std::string(bytes)}});
}

fs::path StagedFiles::add(const fs::path& target, const std::vector<OutputFile>& files, Links links) {
  open(target, links);
  const fs::path main = links == Links::followed ? with_links_followed(target) : target;
  for (const OutputFile& file : files) {
    const fs::path name = file.name.empty() ? main.filename() : file.name;
    if (!file.name.empty()) require_place_beside(main, name);
    const fs::path staging = staging_of(main);
    const File added = {staging / new_folder / name, folder_of(main) / name, staging / old_folder / name,
                        file.replaces};
    std::error_code error;
    // Whoever interrupts the process may have removed the temporary folder, which must not be made anew.
    if (fs::exists(staging, error)) fs::create_directories(added.staged.parent_path(), error);
    const int failed = error ? platform::errno_of(error) : platform::write_new_file(added.staged, file.bytes);
    if (failed != 0) throw_write_error(added.target.string() + ": cannot be written", failed);
    files_.push_back(added);
  }
  return staging_of(main) / new_folder / main.filename();
}

std::vector<fs::path> StagedFiles::folders() const {
  std::vector<fs::path> all;
  if (is_kept_) return all;
  for (const auto& [folder, staging] : folders_) all.push_back(staging);
  return all;
}

const StagedFiles::File* StagedFiles::changed_file() const {
  for (const File& file : files_) {
    if (!file.replaces) continue;
    const platform::FileStatus status = platform::status_of(file.old);
    if (status.kind == platform::FileKind::none || status.stamp != *file.replaces) return &file;
  }
  return nullptr;
}

void StagedFiles::prepare() const {
  for (const File& file : files_) {
    require_replaceable(file.target);
    platform::copy_permissions(file.target, file.staged);
    std::error_code error;
    fs::create_directories(file.old.parent_path(), error);
    if (error) throw_write_error(file.target.string() + ": cannot be written", platform::errno_of(error));
  }
}

void StagedFiles::commit() {
  guarded([this] { move_into_place(); });
}

void StagedFiles::move_into_place() {
  prepare();
  Moves moves(files_);
  const auto all = [&](auto step) {
    for (std::size_t i = files_.size(); i-- > 0;)
      if (!(moves.*step)(i)) return false;
    return true;
  };
  const File* changed = nullptr;
  const bool is_done =
      all(&Moves::put_aside) && moves.make_folders() && (changed = changed_file()) == nullptr && all(&Moves::replace);
  if (!is_done) {
    is_kept_ = !moves.take_back();
    const std::string left = is_kept_ ? where_old_files_are() : "";
    if (changed != nullptr)
      throw ChangedMeanwhile(fmt::format("{}: was changed or replaced after it was read, and is left as it is{}",
                                         changed->target.string(), left));
    throw_write_error(fmt::format("{}: cannot be written{}", moves.failed().string(), left), moves.reason());
  }
  for (const File& file : files_) platform::flush_folder(folder_of(file.target));
  files_.clear();
}

std::string StagedFiles::where_old_files_are() const {
  std::string folders;
  for (const auto& [folder, staging] : folders_)
    folders += (folders.empty() ? "" : ", ") + (staging / old_folder).string();
  return fmt::format(" (not all old files could be put back: those that are missing are in {})", folders);
}

OutputFolder::OutputFolder(const fs::path& path) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path at = fs::absolute(path, error).lexically_normal(); !fs::exists(at, error) && at.has_relative_path();
       at = at.parent_path())
    if (at.has_filename()) missing.push_back(at);
  fs::create_directories(path, error);
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) {
    if (error) throw_write_error(path.string() + ": cannot make this folder", platform::errno_of(error));
    throw WriteError(path.string() + ": not a folder");
  }
  made_ = std::move(missing);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  for (const fs::path& folder : made_) fs::remove(folder, ignored);  // leaves what holds anything
}

}  // namespace unsnarl
