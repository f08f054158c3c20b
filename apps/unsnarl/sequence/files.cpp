#include "sequence/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>

#include "content_hash.h"
#include "input_bytes.h"
#include "mesh_input.h"
#include "platform/files.h"
#include "staged_output.h"
#include "unsnarl/paths.h"
#include "unsnarl/point_cache.h"
#include "unsnarl/repair_file_steps.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::vector<std::string> matches_of(const std::string& pattern) {
  if (is_there(path_of(pattern))) return {pattern};  // its name may hold brackets
  std::vector<std::string> paths;
  const int failure = platform::find_matches(pattern, is_error_of_system, paths);
  if (failure != 0) throw_read_error(pattern + ": cannot list the folder", failure);
  if (paths.empty()) throw FileError(pattern + ": there is no such file");
  return paths;
}

/// The numbers in a name, but those too long to count with.
std::vector<long long> numbers_in(const std::string& path) {
  const std::string name = path_of(path).stem().string();
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  std::vector<long long> numbers;
  for (auto begin = std::find_if(name.begin(), name.end(), is_digit); begin != name.end();) {
    const auto end = std::find_if_not(begin, name.end(), is_digit);
    if (end - begin <= 15) numbers.push_back(std::stoll(std::string(begin, end)));
    begin = std::find_if(end, name.end(), is_digit);
  }
  return numbers;
}

/// The numbers that tell frames apart: the last ones in their names, but not those that are the same in all names
/// ("f2_lod0" is frame 2).
std::vector<long long> frame_numbers(const std::vector<std::string>& paths) {
  std::vector<std::vector<long long>> all;
  for (const std::string& path : paths) {
    all.push_back(numbers_in(path));
    if (all.back().empty()) throw UsageError(fmt::format("{}: the name has no frame number", path));
  }
  const auto ends_alike = [&](const std::vector<long long>& numbers) {
    return numbers.size() > 1 && numbers.size() == all[0].size() && numbers.back() == all[0].back();
  };
  while (std::all_of(all.begin(), all.end(), ends_alike))
    for (std::vector<long long>& numbers : all) numbers.pop_back();
  std::vector<long long> last;
  for (const std::vector<long long>& numbers : all) last.push_back(numbers.back());
  return last;
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
  if (paths.size() < 2) return paths;
  const std::vector<long long> numbers = frame_numbers(paths);
  for (std::size_t t = 1; t < paths.size(); ++t) {
    const long long step = numbers[1] - numbers[0], here = numbers[t] - numbers[t - 1];
    if (here == 0)
      throw UsageError(fmt::format("{} and {} have the same frame number, {}", paths[t - 1], paths[t], numbers[t]));
    if (here != step)
      throw UsageError(
          fmt::format("the numbers of the frames go up by {}, but by {} from {} to {}: is a frame missing, "
                      "or one too many?",
                      step, here, paths[t - 1], paths[t]));
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
        folder_(path_of(folder)),
        recompute_normals_(recompute_normals),
        interruption_(interruption),
        first_(read_inputs({paths_[0]}, format)) {
    if (!external_files(first_.document(0)).empty())
      throw UsageError(paths_[0] + ": this file keeps its numbers in other files; each frame must be a single file");
  }

  std::size_t count() const override { return paths_.size(); }
  std::string name(std::size_t t) const override { return names_[t]; }
  const SceneDocument& mesh() const override { return first_; }
  bool stores_float32() const override { return first_.float32_file().has_value(); }
  std::string output() const override { return folder_.string(); }
  void claim(FilePlaces& places) const override {
    for (const std::string& path : paths_) places.reads("one of the frames", path);
    for (std::size_t t = 0; t < paths_.size(); ++t)
      places.writes("a repaired frame", target(t).string(), "it would be overwritten; use another folder");
  }

  std::string content_hash(std::size_t t) override {
    require_same_faces(Document::read(path_of(paths_[t]), format_), t);
    return sha256_of_file(path_of(paths_[t]));
  }

  std::vector<double> positions(std::size_t t) override {
    Document document = Document::read(path_of(paths_[t]), format_);
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
    return write_to(target(t), t, positions, float32);
  }
  std::string write_partial(std::size_t t, std::span<const double> positions, bool float32) override {
    const fs::path place = with_infix(target(t), partial_infix);
    write_to(place, t, positions, float32);
    return place.string();
  }
  void flush_partial() override {}
  bool is_one_file() const override { return false; }
  void gather(const IsRecorded&) override {}
  void flush(const IsRecorded&) override {}
  bool finish(const IsRecorded&) override { return true; }
  std::size_t frames_between_flushes() const override { return 1; }

 private:
  fs::path target(std::size_t t) const { return folder_ / path_of(names_[t]); }

  std::vector<double> write_to(const fs::path& place, std::size_t t, std::span<const double> positions, bool float32) {
    if (!external_files(document(t)).empty())
      throw UsageError(names_[t] + ": this file keeps its numbers in other files; each frame must be a single file");
    StagedOutput output(interruption_);
    const Document written = stage_document(document(t), positions, float32, place, output.files());
    require_same_faces(written, t);
    output.commit();
    const std::lock_guard lock(mutex_);
    documents_.erase(documents_.begin(), documents_.upper_bound(t));
    return written.surface().positions;
  }

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
    for (std::size_t f = 0; f < faces; ++f) {
      const auto face = here.view().face(f), its_first = first.view().face(f);
      if (!std::equal(face.begin(), face.end(), its_first.begin(), its_first.end()))
        throw FileError(
            fmt::format("{}: face {} (counting from 0) has other vertices than in {}: frames need the same "
                        "faces",
                        paths_[t], f, names_[0]));
    }
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

/// A mesh and a point cache. Until all frames are done, what there is of the output has another name.
class CacheFrames : public SequenceFiles {
 public:
  CacheFrames(const std::string& mesh, const std::string& cache, std::optional<Format> format,
              const std::string& folder, Interruption& interruption)
      : interruption_(interruption),
        mesh_(read_inputs({mesh}, format)),
        name_(path_of(cache).filename().string()),
        target_(path_of(folder) / path_of(name_)),
        part_(path_of(folder) / path_of(name_ + ".part")),
        inputs_{mesh, cache},
        input_(parsed(path_of(cache), cache)),
        output_(input_),
        is_done_(input_.frames(), false) {
    const std::size_t vertices = mesh_.surface().view().vertex_count();
    if (input_.points() != vertices)
      throw FileError(fmt::format("{}: {} points, but {} has {} vertices", cache, input_.points(), mesh, vertices));
  }

  std::size_t count() const override { return input_.frames(); }
  std::string name(std::size_t t) const override { return fmt::format("{} frame {}", name_, t); }
  const SceneDocument& mesh() const override { return mesh_; }
  bool stores_float32() const override { return true; }
  std::string output() const override { return target_.string(); }
  void claim(FilePlaces& places) const override {
    for (const std::string& input : inputs_) places.reads("one of the frames", input);
    for (const fs::path& place : {target_, part_})
      places.writes("the repaired cache", place.string(), "it would be overwritten; use another folder");
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
    is_done_[t] = true;
    is_flushed_ = false;
    return output_.positions(t);
  }

  std::string write_partial(std::size_t t, std::span<const double> positions, bool) override {
    partial_[t].assign(positions.begin(), positions.end());
    return partial_place().string();
  }
  void flush_partial() override {
    if (partial_.empty()) return;
    PointCache cache = output_;
    for (const auto& [t, positions] : partial_) cache.set_positions(t, positions);
    write_file(partial_place().string(), cache.bytes(), interruption_);
  }

  bool is_one_file() const override { return true; }
  void gather(const IsRecorded& is_recorded) override {
    for (const fs::path& place : {part_, target_}) {
      const std::optional<PointCache> found = earlier(place);
      for (std::size_t t = 0; found && t < count(); ++t) {
        if (is_done_[t] || !is_recorded(t, sha256(found->frame_bytes(t)))) continue;
        output_.set_positions(t, found->positions(t));
        is_done_[t] = true;
      }
    }
  }
  void flush(const IsRecorded& is_recorded) override {
    if (is_flushed_) return;
    gather(is_recorded);
    write_file(part_.string(), output_.bytes(), interruption_);
    is_flushed_ = true;
  }
  std::size_t frames_between_flushes() const override { return whole_writes_after; }
  bool finish(const IsRecorded& is_recorded) override {
    gather(is_recorded);
    if (std::find(is_done_.begin(), is_done_.end(), false) != is_done_.end()) return false;
    write_file(target_.string(), output_.bytes(), interruption_);
    std::error_code ignored;
    fs::remove(part_, ignored);
    return true;
  }

 private:
  fs::path partial_place() const { return with_infix(target_, partial_infix); }
  static PointCache parsed(const fs::path& path, const std::string& named) {
    return parse_file(path.string(), [&](std::string bytes) {
      return PointCache::parse(std::move(bytes), *point_cache_format(named));
    });
  }

  /// A cache of as many points and frames at this place; empty: there is none.
  std::optional<PointCache> earlier(const fs::path& place) const {
    if (!is_there(place)) return {};
    try {
      PointCache found = parsed(place, name_);
      if (found.points() == input_.points() && found.frames() == input_.frames()) return found;
    } catch (const FileError&) {
      // A file that is no cache holds no frame that is recorded.
    }
    return {};
  }

  Interruption& interruption_;
  const SceneDocument mesh_;
  const std::string name_;
  const fs::path target_, part_;
  const std::vector<std::string> inputs_;
  const PointCache input_;
  PointCache output_;
  std::vector<bool> is_done_;  // frames of output_ that are recorded or written; all others are the input's
  std::map<std::size_t, std::vector<double>> partial_;  // what was reached of frames that did not end clean
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
                                     : ": one frame is not a sequence; leave --sequence out, or give more files or a "
                                       "pattern"));
  }
  return std::make_unique<NumberedFiles>(std::move(paths), format, folder, recompute_normals, interruption);
}

}  // namespace unsnarl::app
