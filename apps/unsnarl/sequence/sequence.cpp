#include "sequence/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>
#include <vector>

#include "content_hash.h"
#include "file_places.h"
#include "mesh_input.h"
#include "platform/process.h"
#include "progress.h"
#include "sequence/files.h"
#include "sequence/record.h"
#include "staged_output.h"
#include "standard_streams.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/paths.h"
#include "unsnarl/report_json.h"
#include "unsnarl/sequence.h"
#include "unsnarl/stage_clock.h"
#include "unsnarl/version.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* record_name = "unsnarl-sequence.jsonl";
constexpr int report_version = 1;  // raised when a key is renamed, removed or changes its meaning

/// The folder of the outputs. Throws UsageError.
const std::string& checked_folder(const FixOptions& options) {
  const auto refuse = [](bool given, const char* option) {
    if (given) throw UsageError(fmt::format("{} does not work with --sequence; repair a single frame instead", option));
  };
  if (options.in_place || options.output.empty() || is_stream(options.output))
    throw UsageError("--sequence needs -o FOLDER; the frames are written there under their names");
  refuse(!options.picture.empty(), "--picture");
  refuse(!options.view.empty(), "--view");
  refuse(!options.record.empty(), "--record");
  refuse(!options.highlight.empty(), "--highlight");
  if (!options.nested.empty())
    throw UsageError(
        "--nested does not work with --sequence, whose files are frames of one mesh; repair single frames");
  if (!options.rigid.empty())
    throw UsageError(
        "--rigid does not work with --sequence; repair single frames, or keep the part fixed with --fix-object or "
        "--fix-group");
  return options.output;
}

/// "a:b", either of which may be left out: [a, b), counted from 0.
std::pair<std::size_t, std::size_t> range_of(const std::string& text, std::size_t count) {
  const auto number = [&](std::string_view word, std::size_t otherwise) {
    std::size_t value = otherwise;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (!word.empty() && (error != std::errc{} || end != word.data() + word.size()))
      throw UsageError(fmt::format("--frames must be FIRST:LAST, whole numbers from 0, as in 0:24, not '{}'", text));
    return value;
  };
  if (text.empty()) return {0, count};
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    throw UsageError(fmt::format("--frames must be FIRST:LAST, as in 0:24, not '{}'", text));
  const std::size_t first = number(std::string_view(text).substr(0, colon), 0);
  const std::size_t last = number(std::string_view(text).substr(colon + 1), count);
  if (first >= last || last > count)
    throw UsageError(
        fmt::format("--frames {}: the sequence has {} frames; FIRST counts from 0, LAST is not included", text, count));
  return {first, last};
}

Json jitter_json(const std::optional<Jitter>& jitter) {
  return jitter ? Json{{"mean_rel", jitter->mean_rel}, {"max_rel", jitter->max_rel}} : Json();
}

bool is_good(Status status) {
  return is_resolved(status) || status == Status::obstructed;
}

class SequenceRun {
 public:
  SequenceRun(const FixOptions& options, Interruption& interruption)
      : options_(options),
        interruption_(interruption),
        display_(options.progress, options.quiet),
        folder_(path_of(checked_folder(options))),
        files_(open_sequence(options.inputs, format_from_name(options.format), options.output,
                             options.recompute_normals, interruption)),
        record_(path_of(options.output) / record_name),
        done_(files_->count()) {}

  int run() {
    std::tie(sequence_.first, sequence_.last) = range_of(options_.frames, files_->count());
    sequence_.repair = repair_options(options_, files_->mesh());
    sequence_.repair.as_written = {};
    if (files_->stores_float32()) {
      if (sequence_.repair.precision == Precision::float64)
        throw UsageError("--precision float64: a point cache stores 32-bit numbers; leave the option out");
      sequence_.repair.precision = Precision::float32;
    }
    for (const std::string& note : files_->mesh().notes()) display_.say("note: {}", note);
    require_own_places();
    display_.begin("read");
    read_contents();
    if (files_->is_one_file()) {
      const auto lock = record_.lock();
      files_->gather(is_recorded());
    }

    Context context;
    context.on_progress = [&](const Context::Progress& progress) { display_.show(progress); };
    interruption_.set_handler([&] {
      context.cancel();
      if (!options_.quiet) tell("\nstopping; finished frames are kept; run the same command again to continue\n");
    });
    display_.count("frames", sequence_.last - sequence_.first);
    display_.begin("frames");
    reports_ = repair_sequence(
        source(), sequence_, [&](FrameResult&& result) { take(std::move(result)); }, &context);
    interruption_.set_handler(nullptr);
    flush();
    files_->flush_partial();
    if (context.is_cancelled()) exit_code_ = exit_cancelled;
    is_range_done_ = unwritten_ == 0 && !context.is_cancelled();
    if (is_range_done_) {
      const auto lock = record_.lock();
      is_whole_ = files_->finish(is_recorded());
    }
    if (!options_.report.empty()) write_file(options_.report, report_json() + "\n", interruption_);
    summarise();
    return exit_code_;
  }

 private:
  void require_own_places() const {
    FilePlaces places;
    files_->claim(places);
    places.reads("--fix-vertices", options_.fix_vertices);
    const fs::path record = path_of(options_.output) / record_name;
    places.writes("the record of what is done", record.string());
    places.writes("--report", options_.report);
    for (const fs::path& place : {record, path_of(options_.report)})
      if (!place.empty() && !is_stream(place.string())) StagedOutput(interruption_).files().open(place);
  }

  /// Checks all frames that matter before any work.
  void read_contents() {
    // In one file, frames outside the range matter too, for they may be done.
    const bool all = files_->is_one_file();
    const std::size_t begin = all ? 0 : deciding_frames(sequence_.first, files_->count()).first;
    const std::size_t end = all ? files_->count() : deciding_frames(sequence_.last - 1, files_->count()).last;
    contents_.resize(files_->count());
    for (std::size_t t = begin; t < end; ++t) contents_[t] = files_->content_hash(t);
    Json asked = Json::parse(unsnarl::report_json({}, sequence_.repair))["options"];
    asked.erase("threads");  // they change no byte
    const std::vector<std::uint8_t>& fixed = sequence_.repair.fixed;
    asked_for_ = sha256(asked.dump() + sha256(std::string(fixed.begin(), fixed.end())) + what_may_pass() +
                        (options_.recompute_normals ? "normals" : "") + sha256_of_file(platform::program_file()));
  }

  /// A text that differs wherever other pairs are allowed; empty: none is.
  std::string what_may_pass() const {
    const AllowedPairs& allowed = sequence_.repair.find.allowed;
    if (allowed.empty()) return {};
    return sha256(fmt::format("{} {}", fmt::join(allowed.part_of_face, ","), Json(allowed.parts).dump()));
  }

  /// Hashes everything that decides what a frame becomes.
  std::string key_of(std::size_t t) const {
    std::string all = asked_for_;
    const DecidingFrames deciding = deciding_frames(t, files_->count());
    const auto seen_from_here = [&](std::size_t s) { return static_cast<long>(s) - static_cast<long>(t); };
    for (std::size_t s = deciding.first; s < deciding.last; ++s)
      all +=
          fmt::format(" {}:{}:{}", seen_from_here(s), seen_from_here(key_frame_of(s, files_->count())), contents_[s]);
    return sha256(all);
  }

  SequenceSource source() {
    SequenceSource source;
    const Surface& faces = files_->mesh().surface();
    source.corners = faces.corners;
    source.offsets = faces.offsets;
    source.frames = files_->count();
    source.positions = [this](std::size_t t) { return files_->positions(t); };
    source.done = [this](std::size_t t) {
      const Json* const line = record_.find(files_->name(t), key_of(t), files_->output_hash(t));
      const std::optional<Status> status = line ? status_of((*line)["report"]) : std::nullopt;
      if (!status || !is_good(*status)) return std::vector<double>();  // what was reached is tried again
      done_[t] = (*line)["report"];
      note_status(*status);
      ++done_before_;
      return files_->output_positions(t);
    };
    source.as_written = [this](std::size_t t, std::span<const double> positions, bool float32) {
      return files_->as_written(t, positions, float32);
    };
    return source;
  }

  void take(FrameResult&& result) {
    const std::size_t t = result.report.frame;
    note_status(result.report.status);
    if (!is_good(result.report.status) && !options_.keep_partial) {
      ++unwritten_;
      return keep_partial(result);
    }
    const bool float32_digits = result.report.precision == Precision::float32;
    // The certificate is about these positions, bit for bit.
    if (files_->write(t, result.positions, float32_digits) != result.positions)
      throw std::logic_error(files_->name(t) + ": the written file is not what was certified");
    done_[t] = Json::parse(frame_json(result.report));
    unrecorded_.push_back(t);
    if (unrecorded_.size() >= files_->frames_between_flushes()) flush();
  }

  /// True if a state better than the input was reached.
  void keep_partial(const FrameResult& result) {
    const std::size_t t = result.report.frame;
    const bool is_kept =
        !options_.no_partial && result.report.status != Status::no_progress && result.report.displacement_max_rel > 0;
    if (is_kept)
      partial_[t] = files_->write_partial(t, result.positions, result.report.precision == Precision::float32);
    display_.say("{}: {}; {}", files_->name(t), to_string(result.report.status),
                 is_kept ? fmt::format("the incomplete result goes to {}", partial_[t])
                         : "no file written; --keep-partial writes the incomplete result");
  }

  /// Records all frames that have been written.
  void flush() {
    if (unrecorded_.empty()) return;
    const auto lock = record_.lock();
    files_->flush(is_recorded());
    for (const std::size_t t : unrecorded_) record_.add(files_->name(t), key_of(t), files_->output_hash(t), done_[t]);
    unrecorded_.clear();
  }

  IsRecorded is_recorded() const {
    return [this](std::size_t t, const std::string& output_hash) {
      return record_.find(files_->name(t), key_of(t), output_hash) != nullptr;
    };
  }

  /// Returns the status in a report that was recorded; nothing if the report has none.
  static std::optional<Status> status_of(const Json& report) {
    return status_from_name(report.value("status", std::string()));
  }

  /// The exit code is that of the first frame that is not written whole; else of an obstructed one, an allowed one, one
  /// whose gap is not met.
  void note_status(Status status) {
    const auto rank = [](ExitCode code) {
      switch (code) {
        case exit_embedded: return 0;
        case exit_gap_not_met: return 1;
        case exit_allowed: return 2;
        case exit_obstructed: return 3;
        default: return 4;
      }
    };
    const ExitCode code = exit_code_of(status);
    if (rank(code) > rank(exit_code_)) exit_code_ = code;
  }

  struct Summary {
    std::size_t allowed_before = 0, allowed_after = 0;  // pairs
    std::size_t frames = 0, pairs_before = 0, pairs_after = 0, with_pairs = 0, smoothed = 0, jitter_frames = 0;
    double displacement_mean = 0, displacement_max = 0;  // / diagonal of each frame
    double mean_length = 0, max_length = 0;              // the same in the units of the file
    double untouched_mean = 0, untouched_min = 1;
    Jitter jitter, alone;                 // over the frames of which both are known
    std::size_t farthest = 0;             // the frame of displacement_max
    std::vector<std::size_t> unsmoothed;  // frames that were repaired, each by itself
  };
  Summary summary() const;
  std::string names_of_frames(const std::vector<std::size_t>& frames) const;
  std::string report_json() const;
  void summarise();

  const FixOptions& options_;
  Interruption& interruption_;
  StageClock clock_;
  ProgressDisplay display_;
  OutputFolder folder_;
  std::unique_ptr<SequenceFiles> files_;
  SequenceRecord record_;
  SequenceOptions sequence_;
  std::vector<std::string> contents_;  // hash of each frame that matters; else empty
  std::string asked_for_;              // hash of the program and its options
  std::vector<Json> done_;             // report of each frame that is written; null: it is not
  std::vector<std::size_t> unrecorded_;
  std::map<std::size_t, std::string> partial_;  // where what was reached of a frame is, which is not written
  std::size_t done_before_ = 0, unwritten_ = 0;
  bool is_range_done_ = false, is_whole_ = false;
  std::vector<FrameReport> reports_;
  ExitCode exit_code_ = exit_embedded;
};

SequenceRun::Summary SequenceRun::summary() const {
  Summary sum;
  for (const FrameReport& report : reports_) {
    const Json& frame = done_[report.frame];
    if (frame.is_null()) continue;
    ++sum.frames;
    sum.pairs_before += frame["before"]["total"].get<std::size_t>();
    sum.pairs_after += frame["after"]["total"].get<std::size_t>();
    sum.allowed_before += frame["allowed"]["before"]["total"].get<std::size_t>();
    sum.allowed_after += frame["allowed"]["after"]["total"].get<std::size_t>();
    sum.with_pairs += frame["before"]["total"] != 0;
    sum.smoothed += frame["is_smoothed"].get<bool>();
    sum.displacement_mean += report.displacement_mean_rel;
    if (report.displacement_max_rel > sum.displacement_max) {
      sum.displacement_max = report.displacement_max_rel;
      sum.farthest = report.frame;
    }
    if (report.untouched_share < 1 && !frame["is_smoothed"].get<bool>()) sum.unsmoothed.push_back(report.frame);
    sum.mean_length += report.displacement_mean_rel * report.diagonal;
    sum.max_length = std::max(sum.max_length, report.displacement_max_rel * report.diagonal);
    sum.untouched_mean += report.untouched_share;
    sum.untouched_min = std::min(sum.untouched_min, report.untouched_share);
    const Json& alone = frame["jitter_alone"];
    if (!report.jitter || alone.is_null()) continue;
    ++sum.jitter_frames;
    sum.jitter.mean_rel += report.jitter->mean_rel;
    sum.alone.mean_rel += alone["mean_rel"].get<double>();
    sum.jitter.max_rel = std::max(sum.jitter.max_rel, report.jitter->max_rel);
    sum.alone.max_rel = std::max(sum.alone.max_rel, alone["max_rel"].get<double>());
  }
  const double n = std::max<double>(1, static_cast<double>(sum.frames));
  const double m = std::max<double>(1, static_cast<double>(sum.jitter_frames));
  sum.displacement_mean /= n;
  sum.mean_length /= n;
  sum.untouched_mean /= n;
  sum.jitter.mean_rel /= m;
  sum.alone.mean_rel /= m;
  return sum;
}

/// The first few by name, the others by number.
std::string SequenceRun::names_of_frames(const std::vector<std::size_t>& frames) const {
  constexpr std::size_t most_names = 8;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(frames.size(), most_names); ++i) names.push_back(files_->name(frames[i]));
  if (frames.size() > most_names) names.push_back(fmt::format("{} more", frames.size() - most_names));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string SequenceRun::report_json() const {
  const Summary sum = summary();
  Json json = {{"schema", "unsnarl-sequence-report"},
               {"schema_version", report_version},
               {"version", version},
               {"exit_code", static_cast<int>(exit_code_)},
               {"output", files_->output()},
               {"frames", files_->count()},
               {"range", {sequence_.first, sequence_.last}},
               {"written", sum.frames},
               {"done_before", done_before_},
               {"smoothed", sum.smoothed},
               {"displacement_mean_rel", sum.displacement_mean},
               {"displacement_mean", sum.mean_length},
               {"displacement_max_rel", sum.displacement_max},
               {"displacement_max", sum.max_length},
               {"untouched_share_mean", sum.untouched_mean},
               {"untouched_share_min", sum.untouched_min},
               {"jitter", jitter_json(sum.jitter)},
               {"jitter_alone", jitter_json(sum.alone)},
               {"options", Json::parse(unsnarl::report_json({}, sequence_.repair))["options"]},
               {"list", Json::array()}};
  for (const FrameReport& report : reports_) {
    const Json& frame = done_[report.frame];
    Json line = {{"frame", report.frame}, {"name", files_->name(report.frame)}, {"written", !frame.is_null()}};
    const auto partial = partial_.find(report.frame);
    line["partial"] = partial == partial_.end() ? Json() : Json(partial->second);
    line.update(frame.is_null() ? Json::parse(frame_json(report)) : frame);
    line["frame"] = report.frame;  // a recorded frame may have had another number
    line["jitter"] = jitter_json(report.jitter);
    json["list"].push_back(std::move(line));
  }
  const StageReport whole = clock_.stage("sequence");
  json["seconds"] = whole.seconds;
  json["cpu_seconds"] = whole.cpu_seconds;
  json["peak_memory_mb"] = whole.peak_memory_mb;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

void SequenceRun::summarise() {
  const Summary sum = summary();
  const StageReport whole = clock_.stage("sequence");
  const SurfaceView mesh = files_->mesh().surface();
  const std::size_t frames = sequence_.last - sequence_.first;
  const auto s = [](std::size_t count) { return count == 1 ? "" : "s"; };
  display_.say("{} frame{} of {} vertices, {} faces{}", frames, s(frames), mesh.vertex_count(), mesh.face_count(),
               done_before_ > 0 ? fmt::format("; {} were done before", done_before_) : "");
  display_.say("  intersecting pairs before: {}, in {} frame{}", sum.pairs_before, sum.with_pairs, s(sum.with_pairs));
  if (sum.allowed_before + sum.allowed_after > 0)
    display_.say("  pairs that may intersect:  {} before, {} after", sum.allowed_before, sum.allowed_after);
  display_.say("  intersecting pairs after:  {}", sum.pairs_after == 0 ? "none" : std::to_string(sum.pairs_after));
  if (sum.frames > 0)
    display_.say(
        "  moved {:.3g} % of the vertices, by {:.2g} ({:.2g} % of the diagonal) at most, {:.2g} ({:.2g} %) on average",
        100 * (1 - sum.untouched_mean), sum.max_length, 100 * sum.displacement_max, sum.mean_length,
        100 * sum.displacement_mean);
  if (sum.displacement_max > 0)
    display_.say("  largest move: in {}, by {:.2g} % of the diagonal", files_->name(sum.farthest),
                 100 * sum.displacement_max);
  if (!sum.unsmoothed.empty())
    display_.say("  not smoothed in time (repaired as single frames): {}", names_of_frames(sum.unsmoothed));
  if (sum.jitter_frames > 0)
    display_.say(
        "  flicker from frame to frame: {:.2g} % of the diagonal at most, {:.2g} % on average; without smoothing "
        "{:.2g} % "
        "and {:.2g} %",
        100 * sum.jitter.max_rel, 100 * sum.jitter.mean_rel, 100 * sum.alone.max_rel, 100 * sum.alone.mean_rel);
  display_.say("  {} of {} frame{} written; {:.1f} s, {:.0f} MB", sum.frames, frames, s(frames), whole.seconds,
               whole.peak_memory_mb);
  if (is_whole_) display_.say("  wrote {}", files_->output());
  if (is_range_done_ && !is_whole_)
    display_.say("  gathered in {}.part until all {} frames are done", files_->output(), files_->count());
  if (!partial_.empty())
    display_.say("  {} frame{} not repaired completely: the best result so far is in {}{}", partial_.size(),
                 partial_.size() == 1 ? " is" : "s are", partial_.begin()->second,
                 partial_.begin()->second == partial_.rbegin()->second ? "" : " and so on");
}

}  // namespace

int run_sequence(const FixOptions& options, Interruption& interruption) {
  return SequenceRun(options, interruption).run();
}

}  // namespace unsnarl::app
