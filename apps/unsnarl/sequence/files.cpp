#include "sequence/files.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>

#include "content_hash.h"
#include "mesh_input.h"
#include "staged_output.h"
#include "unsnarl/point_cache.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path.string() + ": cannot open");
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw FileError(path.string() + ": cannot read");
  return bytes;
}

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool is_same(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return a.lexically_normal() == b.lexically_normal() || fs::equivalent(a, b, ignored);
}

void refuse_to_overwrite(const fs::path& input, const fs::path& output) {
  if (is_same(input, output))
    throw UsageError(fmt::format("{} would be overwritten; name another folder", input.string()));
}

std::vector<std::string> matches_of(const std::string& pattern) {
  if (is_there(pattern)) return {pattern};  // its name may hold brackets
  glob_t found{};
  const int status = ::glob(pattern.c_str(), 0, nullptr, &found);
  std::vector<std::string> paths(found.gl_pathv, found.gl_pathv + (status == 0 ? found.gl_pathc : 0));
  ::globfree(&found);
  if (paths.empty()) throw FileError(pattern + ": there is no such file");
  return paths;
}

/// The number that tells frames apart: the last one in the name. Empty: none, or too long to count with.
std::optional<long long> number_in(const std::string& path) {
  const std::string name = fs::path(path).stem().string();
  std::size_t end = name.size();
  while (end > 0 && !std::isdigit(static_cast<unsigned char>(name[end - 1]))) --end;
  std::size_t begin = end;
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(name[begin - 1]))) --begin;
  if (begin == end || end - begin > 15) return {};
  return std::stoll(name.substr(begin, end - begin));
}

/// Frames in natural order, one of each, with numbers that go up evenly.
std::vector<std::string> sorted_frames(const std::vector<std::string>& patterns) {
  std::vector<std::string> paths;
  for (const std::string& pattern : patterns) {
    const std::vector<std::string> more = matches_of(pattern);
    paths.insert(paths.end(), more.begin(), more.end());
  }
  std::sort(paths.begin(), paths.end(), natural_order);
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
  std::optional<long long> step;
  for (std::size_t t = 1; t < paths.size(); ++t) {
    const std::optional<long long> before = number_in(paths[t - 1]), here = number_in(paths[t]);
    if (!before || !here)
      throw UsageError(fmt::format("{}: there is no number in this name that says which frame it is",
                                   before ? paths[t] : paths[t - 1]));
    if (step && *here - *before != *step)
      throw UsageError(
          fmt::format("the numbers of the frames go up by {}, but by {} from {} to {}: is a frame missing, "
                      "or one too many?",
                      *step, *here - *before, paths[t - 1], paths[t]));
    step = *here - *before;
  }
  return paths;
}

/// Frames of a point cache between two writes of the whole.
constexpr std::size_t whole_writes_after = 16;

/// A mesh file a frame.
class NumberedFiles : public SequenceFiles {
 public:
  NumberedFiles(std::vector<std::string> paths, std::optional<Format> format, const std::string& folder,
                bool recompute_normals, Interruption& interruption)
      : paths_(std::move(paths)),
        names_(scene_names(paths_)),
        format_(format),
        folder_(folder),
        recompute_normals_(recompute_normals),
        interruption_(interruption),
        first_(read_scene({paths_[0]}, format)) {
    for (std::size_t t = 0; t < paths_.size(); ++t) refuse_to_overwrite(paths_[t], target(t));
  }

  std::size_t count() const override { return paths_.size(); }
  std::string name(std::size_t t) const override { return names_[t]; }
  const SceneDocument& mesh() const override { return first_; }
  bool stores_float32() const override { return first_.float32_file().has_value(); }
  std::string output() const override { return folder_.string(); }
  bool holds(const fs::path& path) const override {
    for (std::size_t t = 0; t < paths_.size(); ++t)
      if (is_same(path, paths_[t]) || is_same(path, target(t))) return true;
    return false;
  }

  std::string content_hash(std::size_t t) override {
    require_same_faces(Document::read(paths_[t], format_), t);
    return sha256_of_file(paths_[t]);
  }

  std::vector<double> positions(std::size_t t) override {
    Document document = Document::read(paths_[t], format_);
    require_same_faces(document, t);
    if (recompute_normals_) document.recompute_normals();
    const std::lock_guard lock(mutex_);
    return documents_.insert_or_assign(t, std::move(document)).first->second.surface().positions;
  }

  std::vector<double> as_written(std::size_t t, std::span<const double> positions, bool float32) override {
    return document(t).as_written(positions, float32);
  }

  std::string output_hash(std::size_t t) override { return is_there(target(t)) ? sha256_of_file(target(t)) : ""; }
  std::vector<double> output_positions(std::size_t t) override {
    return Document::read(target(t), first_.document(0).format()).surface().positions;
  }

  std::vector<double> write(std::size_t t, std::span<const double> positions, bool float32) override {
    const std::vector<OutputFile> files = document(t).patched(positions, float32);
    if (files.size() > 1)
      throw UsageError(names_[t] + ": this glTF keeps its geometry in other files; give frames of one file each");
    StagedOutput staged(target(t), interruption_);
    staged.write(files);
    const Document written = Document::read(staged.main_file(), first_.document(0).format());
    require_same_faces(written, t);
    staged.commit();
    const std::lock_guard lock(mutex_);
    documents_.erase(documents_.begin(), documents_.upper_bound(t));
    return written.surface().positions;
  }
  void flush() override {}
  std::size_t frames_between_flushes() const override { return 1; }
  void finish() override {}

 private:
  fs::path target(std::size_t t) const { return folder_ / names_[t]; }

  const Document& document(std::size_t t) {
    const std::lock_guard lock(mutex_);
    return documents_.at(t);
  }

  void require_same_faces(const Document& document, std::size_t t) const {
    const Surface &here = document.surface(), &first = first_.surface();
    if (document.format() != first_.document(0).format())
      throw FileError(fmt::format("{}: this is {}, but {} is {}; all frames need one format", paths_[t],
                                  to_string(document.format()), names_[0], to_string(first_.document(0).format())));
    const std::size_t vertices = here.view().vertex_count(), faces = here.view().face_count();
    if (vertices != first.view().vertex_count() || faces != first.view().face_count())
      throw FileError(fmt::format("{}: {} vertices and {} faces, but {} has {} and {}: frames need the same faces",
                                  paths_[t], vertices, faces, names_[0], first.view().vertex_count(),
                                  first.view().face_count()));
    if (here.offsets == first.offsets && here.corners == first.corners) return;
    for (std::size_t f = 0; f < faces; ++f)
      if (!std::ranges::equal(here.view().face(f), first.view().face(f)))
        throw FileError(
            fmt::format("{}: face {} (counting from 0) has other vertices than in {}: frames need the same "
                        "faces",
                        paths_[t], f, names_[0]));
  }

  const std::vector<std::string> paths_, names_;
  const std::optional<Format> format_;
  const fs::path folder_;
  const bool recompute_normals_;
  Interruption& interruption_;
  const SceneDocument first_;
  std::mutex mutex_;  // guards the next
  std::map<std::size_t, Document> documents_;
};

/// A mesh and a point cache. Until all frames wanted are done, what there is of the output has another name.
class CacheFrames : public SequenceFiles {
 public:
  CacheFrames(const std::string& mesh, const std::string& cache, std::optional<Format> format,
              const std::string& folder, Interruption& interruption)
      : interruption_(interruption),
        mesh_(read_scene({mesh}, format)),
        name_(fs::path(cache).filename().string()),
        target_(fs::path(folder) / name_),
        part_(fs::path(folder) / (name_ + ".part")),
        own_{mesh, cache, target_, part_},
        input_(parsed(cache, cache)),
        output_(input_) {
    refuse_to_overwrite(cache, target_);
    const std::size_t vertices = mesh_.surface().view().vertex_count();
    if (input_.points() != vertices)
      throw FileError(fmt::format("{}: {} points, but {} has {} vertices", cache, input_.points(), mesh, vertices));
    for (const fs::path& earlier : {part_, target_}) {
      if (!is_there(earlier)) continue;
      const PointCache found = parsed(earlier, cache);
      if (found.points() != input_.points() || found.frames() != input_.frames()) continue;
      output_ = found;
      break;
    }
  }

  std::size_t count() const override { return input_.frames(); }
  std::string name(std::size_t t) const override { return fmt::format("{} frame {}", name_, t); }
  const SceneDocument& mesh() const override { return mesh_; }
  bool stores_float32() const override { return true; }
  std::string output() const override { return target_.string(); }
  bool holds(const fs::path& path) const override {
    return std::any_of(own_.begin(), own_.end(), [&](const fs::path& own) { return is_same(path, own); });
  }

  std::string content_hash(std::size_t t) override {
    const Surface& faces = mesh_.surface();
    const auto raw = [](const std::vector<std::int32_t>& ids) {
      return std::string_view(reinterpret_cast<const char*>(ids.data()), ids.size() * sizeof(std::int32_t));
    };
    if (faces_hash_.empty()) faces_hash_ = sha256(raw(faces.corners)) + sha256(raw(faces.offsets));
    return sha256(faces_hash_ + sha256(input_.frame_bytes(t)));
  }
  std::vector<double> positions(std::size_t t) override { return input_.positions(t); }
  std::vector<double> as_written(std::size_t, std::span<const double> positions, bool) override {
    return input_.as_written(positions);
  }
  std::string output_hash(std::size_t t) override { return sha256(output_.frame_bytes(t)); }
  std::vector<double> output_positions(std::size_t t) override { return output_.positions(t); }

  std::vector<double> write(std::size_t t, std::span<const double> positions, bool) override {
    output_.set_positions(t, input_.positions(t));  // what does not move has the input's bytes
    output_.set_positions(t, positions);
    is_flushed_ = false;
    return output_.positions(t);
  }
  void flush() override {
    if (!is_flushed_) write_file(part_.string(), output_.bytes(), interruption_);
    is_flushed_ = true;
  }
  std::size_t frames_between_flushes() const override { return whole_writes_after; }
  void finish() override {
    StagedOutput staged(target_, interruption_);
    staged.write({{{}, output_.bytes()}});
    staged.commit();
    std::error_code ignored;
    fs::remove(part_, ignored);
  }

 private:
  static PointCache parsed(const fs::path& path, const std::string& named) {
    try {
      return PointCache::parse(bytes_of(path), *point_cache_format(named));
    } catch (const FileError& error) {
      throw FileError(fmt::format("{}: {}", path.string(), error.what()));
    }
  }

  Interruption& interruption_;
  const SceneDocument mesh_;
  const std::string name_;
  const fs::path target_, part_;
  const std::vector<fs::path> own_;
  const PointCache input_;
  PointCache output_;
  std::string faces_hash_;
  bool is_flushed_ = true;
};

}  // namespace

bool natural_order(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto run = [&](const std::string& text, std::size_t& at) {
      while (at < text.size() && text[at] == '0') ++at;
      const std::size_t begin = at;
      while (at < text.size() && is_digit(text[at])) ++at;
      return text.substr(begin, at - begin);
    };
    const std::string x = run(a, i), y = run(b, j);
    if (x.size() != y.size()) return x.size() < y.size();
    if (x != y) return x < y;
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;  // "f1" and "f01"
}

std::unique_ptr<SequenceFiles> open_sequence(const std::vector<std::string>& inputs, std::optional<Format> format,
                                             const std::string& folder, bool recompute_normals,
                                             Interruption& interruption) {
  const auto is_cache = [](const std::string& path) { return point_cache_format(path).has_value(); };
  const auto cache = std::find_if(inputs.begin(), inputs.end(), is_cache);
  if (cache != inputs.end()) {
    if (inputs.size() != 2 || is_cache(inputs[0]) == is_cache(inputs[1]))
      throw UsageError("a point cache has no faces: give it with its mesh, as in --sequence body.obj walk.pc2");
    return std::make_unique<CacheFrames>(is_cache(inputs[0]) ? inputs[1] : inputs[0], *cache, format, folder,
                                         interruption);
  }
  std::vector<std::string> paths = sorted_frames(inputs);
  if (paths.size() == 1) {
    const std::optional<Format> own = format ? format : format_from_extension(paths[0]);
    throw UsageError(paths[0] + (own == Format::gltf || own == Format::glb
                                     ? ": morph targets and skins of one glTF are not read as frames; export a mesh a "
                                       "frame (OBJ, PLY, GLB), or a mesh and a point cache (PC2, MDD)"
                                     : ": one frame is no sequence; leave --sequence out, or give more files or a "
                                       "pattern"));
  }
  return std::make_unique<NumberedFiles>(std::move(paths), format, folder, recompute_normals, interruption);
}

}  // namespace unsnarl::app
