#include "batch/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <initializer_list>
#include <limits>
#include <map>
#include <thread>

#include "batch/folder.h"
#include "batch/inputs.h"
#include "batch/journal.h"
#include "batch/progress.h"
#include "batch/record.h"
#include "batch/summary.h"
#include "content_hash.h"
#include "file_places.h"
#include "fix.h"
#include "platform/files.h"
#include "platform/process.h"
#include "platform/usage.h"
#include "standard_streams.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/paths.h"
#include "unsnarl/report_json.h"
#include "unsnarl/threads.h"
#include "unsnarl/visible_text.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

namespace fs = std::filesystem;

constexpr int thumbnail_width = 320;  // pixels, of both halves: a row of the page shows it at half that
/// A worker stops at its time limit by itself; one that does not is killed this much later.
constexpr double patience = 1.5, patience_s = 30;
/// Raised where records that were made before must not be taken for done any more.
constexpr std::string_view key_version = "unsnarl batch 1";

/// The options for `unsnarl fix` as that will read them. Throws UsageError.
FixOptions parsed_fix_options(const std::vector<std::string>& words) {
  CLI::App command;
  FixOptions options;
  add_fix_options(command, options);
  std::vector<std::string> reversed(words.rbegin(), words.rend());
  reversed.push_back("IN");
  try {
    command.parse(reversed);
  } catch (const CLI::ParseError& e) {
    throw UsageError(fmt::format("only options of 'unsnarl fix' may follow '--': {}", e.what()));
  }
  const auto refuse = [](bool given, const char* name, const char* instead) {
    if (given) throw UsageError(fmt::format("{} after '--': {}", name, instead));
  };
  refuse(!options.output.empty() || options.in_place, "-o and --in-place", "results go to the folder of the batch");
  for (const auto& [name, path] : {std::pair{"--report", &options.report},
                                   {"--picture", &options.picture},
                                   {"--view", &options.view},
                                   {"--record", &options.record},
                                   {"--highlight", &options.highlight}})
    refuse(!path->empty(), name, "all meshes would write to the same file; run 'unsnarl fix' for a single mesh");
  refuse(options.time_limit_s > 0, "--time-limit", "write it before '--'");
  refuse(options.memory_limit_mb > 0, "--memory-limit", "write it before '--'");
  refuse(options.threads > 0, "--threads", "write it before '--'");
  return options;
}

/// The path of this program. Throws FileError.
std::string own_path() {
  try {
    return platform::program_path().string();
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}; name this program with --worker", error.what()));
  }
}

bool is_success(const std::string& status) {
  const std::optional<Status> known = status_from_name(status);
  return known && (is_resolved(*known) || *known == Status::obstructed);
}

/// Everything around one call of `batch`.
class Batch {
 public:
  Batch(const BatchOptions& options, Interruption& interruption)
      : options_(options),
        interruption_(interruption),
        folder_{path_of(options.output)},
        shard_(shard_from(options.shard)),
        inputs_(batch_inputs(options.input, folder_.root)),
        all_(inputs_.meshes),
        mine_(part_of(all_, shard_)),
        program_(options.worker.empty() ? own_path() : options.worker),
        journal_(folder_.journal()),
        progress_(mine_, options.quiet) {
    const FixOptions fix = parsed_fix_options(options.fix_options);
    require_own_places(fix.fix_vertices);
    const std::string program_hash = sha256_of_file(path_of(program_));
    if (program_hash.empty()) throw FileError(program_ + ": cannot be read; --worker needs a program");
    same_for_all_ = fmt::format("{}\n{}\n", key_version, program_hash);
    for (const std::string& word : options.fix_options) same_for_all_ += word + '\n';
    if (!fix.fix_vertices.empty()) same_for_all_ += sha256_of_file(path_of(fix.fix_vertices)) + '\n';
    jobs_ = options.jobs > 0 ? options.jobs : thread_count();
    threads_ = options.threads > 0 ? options.threads : std::max(1, thread_count() / jobs_);
    memory_limit_mb_ =
        options.memory_limit_mb > 0 ? options.memory_limit_mb : std::floor(0.9 * platform::usable_memory_mb() / jobs_);
    folder_.prepare();
  }

  int run() {
    if (!options_.summary) {
      if (!options_.quiet) describe_inputs();
      work();
      if (error_) std::rethrow_exception(error_);
      if (workers_.is_stopped()) return exit_cancelled;
    }
    const bool is_whole = options_.summary || shard_.count == 1;
    const std::vector<Record> records = is_whole ? records_of(all_) : records_of(mine_);
    if (is_whole) write_batch_summary(folder_, records, interruption_);
    const std::map<std::string, std::size_t> counts = statuses(records);
    if (!options_.quiet) {
      for (const auto& [status, count] : counts) tell(fmt::format("{:>8} {}\n", count, status));
      tell(is_whole ? fmt::format("see {}\n", visible_text((folder_.root / "index.html").string()))
                    : "when all parts are done, run the same command with --summary\n");
    }
    const auto are_all = [&](std::initializer_list<Status> statuses) {
      return std::all_of(counts.begin(), counts.end(), [&](const auto& count) {
        return std::any_of(statuses.begin(), statuses.end(), [&](Status s) { return count.first == to_string(s); });
      });
    };
    if (counts.empty() || !are_all({Status::embedded, Status::allowed, Status::gap_not_met})) return exit_intersecting;
    if (counts.contains(std::string(to_string(Status::allowed)))) return exit_allowed;
    return are_all({Status::embedded}) ? exit_embedded : exit_gap_not_met;
  }

 private:
  void require_own_places(const std::string& fix_vertices) const {
    FilePlaces places;
    if (std::error_code ignored; !fs::is_directory(path_of(options_.input), ignored))
      places.reads("the list of meshes", options_.input);
    places.reads("--fix-vertices", fix_vertices);
    std::vector<BatchMesh> meshes;
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(meshes),
                 [](const BatchMesh& mesh) { return mesh.fault.empty(); });
    for (const BatchMesh& mesh : meshes) places.reads("a mesh of the batch", mesh.path.string());
    for (const BatchMesh& mesh : meshes)
      places.writes("a result of a batch", (folder_.root / path_of(BatchFolder::mesh(mesh.name))).string(),
                    "name another folder for the results");
  }

  /// Says which inputs will not be worked on.
  void describe_inputs() const {
    constexpr std::size_t most_lines = 10;
    std::size_t faults = 0;
    for (const BatchMesh& mesh : all_)
      if (!mesh.fault.empty() && ++faults <= most_lines)
        tell(fmt::format("note: {}: {}\n", visible_text(mesh.name), visible_text(mesh.fault)));
    if (faults > most_lines) tell(fmt::format("note: {} more like these\n", faults - most_lines));
    std::vector<std::string> others;
    for (const auto& [extension, files] : inputs_.others)
      others.push_back(visible_text(
          fmt::format("{} {} ({}{})", files.count, extension, files.count == 1 ? "" : "such as ", files.first)));
    if (others.empty()) return;
    if (others.size() > most_lines) {
      others[most_lines] = fmt::format("{} more kinds", others.size() - most_lines);
      others.resize(most_lines + 1);
    }
    tell(fmt::format("note: skipped, because these formats are not supported: {}\n", fmt::join(others, ", ")));
  }

  std::string key_of(const BatchMesh& mesh, const std::string& content) const {
    return sha256(same_for_all_ + mesh.name + '\n' + content);
  }

  /// The record of a mesh that needs no more work; null otherwise.
  Record finished(const BatchMesh& mesh, const std::string& key) const {
    const JournalEntry* const entry = journal_.find(key);
    if (entry == nullptr || entry->line.empty()) return {};
    Record record = Record::parse(entry->line, nullptr, false);
    if (!record.is_object()) return {};
    const std::string status = record.value("status", "");
    const Record run = record.value("run", Record::object());
    const auto bound = [](double limit) { return limit > 0 ? limit : std::numeric_limits<double>::infinity(); };
    const auto raised = [&](Status limit, const char* name, double now) {
      return status == to_string(limit) && bound(now) > bound(run.value(name, 0.0));
    };
    if (status == status_cannot_write || status == status_system_error || (options_.retry && !is_success(status)) ||
        raised(Status::time_limit, "time_limit_s", options_.time_limit_s) ||
        raised(Status::memory_limit, "memory_limit_mb", memory_limit_mb_))
      return {};
    // The record shows the name of the output; one that is no text has other bytes.
    if (record.contains("output") &&
        sha256_of_file(folder_.root / path_of(BatchFolder::mesh(mesh.name))) != record.value("output_sha256", ""))
      return {};
    const Record buffers = record.value("buffers", Record::object());
    for (const auto& [name, hash] : buffers.items())
      if (sha256_of_file(folder_.root / path_of(decoded_uri(name))) != hash) return {};
    if (options_.thumbnails && record.contains("vertices") && !record.contains("thumbnail")) return {};
    return record;
  }

  /// Works off all meshes of the shard. Sets error_.
  void work() {
    journal_.open(shard_.name(), [this] {
      if (!options_.quiet) tell("waiting: another 'unsnarl batch' is working on this part\n");
    });
    std::error_code ignored;
    fs::remove_all(folder_.work(shard_), ignored);  // of a run that was killed
    interruption_.set_handler([this] {
      workers_.stop_all();
      if (!options_.quiet) tell("\nstopping; results so far are kept; run the same command again to continue\n");
    });
    for (std::size_t i = 0; i < mine_.size(); ++i) todo_.push_back(i);
    // The largest first: at the end no single one keeps the others waiting.
    std::stable_sort(todo_.begin(), todo_.end(),
                     [this](std::size_t a, std::size_t b) { return mine_[a].bytes > mine_[b].bytes; });
    std::vector<std::thread> threads;
    for (int i = 0; i < jobs_; ++i) threads.emplace_back([this] { work_on_all(); });
    std::thread watch([this] { progress_.watch([this] { workers_.stop_late_ones(); }); });
    for (std::thread& thread : threads) thread.join();
    progress_.end();
    watch.join();
    interruption_.set_handler(nullptr);
    fs::remove_all(folder_.work(shard_), ignored);
    fs::remove(folder_.root / "work", ignored);  // where no other shard is at work
  }

  void work_on_all() {
    try {
      for (Task task; next(task);) work_on(task);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      workers_.stop_all();
    }
  }

  struct Task {
    std::size_t mesh = 0;
    int killed = 0;        ///< times its worker was killed in this run
    bool is_late = false;  ///< has waited for all others
  };

  bool next(Task& task) {
    const std::lock_guard lock(mutex_);
    if (workers_.is_stopped()) return false;
    if (!todo_.empty()) {
      task = {todo_.front()};
      todo_.pop_front();
      return true;
    }
    if (late_.empty()) return false;
    task = late_.front();
    late_.pop_front();
    task.is_late = true;
    return true;
  }

  void put_off(const Task& task) {
    const std::lock_guard lock(mutex_);
    late_.push_back(task);
  }

  void work_on(const Task& task) {
    const BatchMesh& mesh = mine_[task.mesh];
    if (!mesh.fault.empty()) return progress_.done(mesh, status_invalid_input);
    try {
      repair_if_needed(mesh, task);
    } catch (const SystemError& error) {
      {
        const std::lock_guard lock(mutex_);
        unread_[mesh.name] = refused(mesh, status_system_error, error.what());
      }
      progress_.done(mesh, status_system_error);
    }
  }

  /// A record of what was not worked on.
  static Record refused(const BatchMesh& mesh, const char* status, const std::string& why) {
    const bool is_of_system = status == std::string_view(status_system_error);
    return {{"mesh", as_utf8(mesh.name)},
            {"status", status},
            {"exit_code", static_cast<int>(is_of_system ? exit_system_error : exit_invalid_input)},
            {"message", visible_text(why)}};
  }

  void repair_if_needed(const BatchMesh& mesh, Task task) {
    const std::string content = content_hash(mesh);
    const std::string key = key_of(mesh, content);
    if (const Record record = finished(mesh, key); !record.is_null()) return progress_.skipped(mesh);
    const JournalEntry* const entry = journal_.find(key);
    const int unexplained = entry == nullptr ? 0 : entry->unexplained;
    // A mesh that was being worked on when the batch was ended may have ended it: it waits until the rest is done.
    if (unexplained > 0 && !task.is_late) return put_off(task);
    Record record;
    if (unexplained >= options_.attempts && !options_.retry) {
      record = {
          {"mesh", as_utf8(mesh.name)},
          {"status", status_ended_the_batch},
          {"message",
           fmt::format("the batch was killed {} times while this mesh was repaired; --retry tries again", unexplained)},
          {"run", Record::object()}};
    } else {
      journal_.started(key);
      try {
        record = repaired(mesh);
      } catch (const SystemError& error) {
        record = refused(mesh, status_system_error, error.what());
      }
      if (workers_.is_stopped()) return journal_.stopped(key);
      if (record["status"] == status_killed && ++task.killed < options_.attempts) {
        journal_.stopped(key);
        return put_off(task);
      }
    }
    record["input_sha256"] = content;
    record["key"] = key;
    record["run"]["attempts"] = task.killed + (record["status"] == status_killed ? 0 : 1);
    record["run"]["host"] = host_;
    record["run"]["time_limit_s"] = options_.time_limit_s;
    record["run"]["memory_limit_mb"] = memory_limit_mb_;
    journal_.ended(key, record.dump(-1, ' ', false, Record::error_handler_t::replace));
    progress_.done(mesh, record["status"]);
  }

  /// Runs `unsnarl fix` in a folder of its own and moves what it wrote into place.
  Record repaired(const BatchMesh& mesh) {
    const fs::path place = folder_.work(shard_) / fmt::format("{}-{}", platform::process_number(), ++places_);
    const fs::path output = place / "out" / path_of(mesh.name).filename(), report = place / "report.json",
                   thumbnail = place / "thumbnail.png", said = place / "said";
    std::error_code error;
    fs::create_directories(place / "out", error);
    if (error) throw_write_error(place.string() + ": cannot make this folder", platform::errno_of(error));
    std::string input = mesh.path.string();
    if (input.starts_with('-')) input = "./" + input;
    std::vector<std::string> words = {"fix",
                                      input,
                                      "-o",
                                      output.string(),
                                      "--report",
                                      report.string(),
                                      "--threads",
                                      std::to_string(threads_),
                                      "--memory-limit",
                                      fmt::format("{}", memory_limit_mb_),
                                      "--time-limit",
                                      fmt::format("{}", options_.time_limit_s),
                                      "--quiet"};
    if (options_.thumbnails)
      words.insert(words.end(), {"--picture", thumbnail.string(), "--picture-width", std::to_string(thumbnail_width)});
    words.insert(words.end(), options_.fix_options.begin(), options_.fix_options.end());
    const double limit_s = options_.time_limit_s > 0 ? patience * options_.time_limit_s + patience_s : 0;
    const WorkerEnd end = workers_.run(program_, words, said, limit_s);
    Record record = record_of(mesh.name, end, report, said);
    if (!workers_.is_stopped() && record["status"] != status_killed) {
      take_over_meshes(mesh, place / "out", record);
      folder_.take_over(report, BatchFolder::report(mesh.name));
      if (folder_.take_over(thumbnail, BatchFolder::thumbnail(mesh.name)))
        record["thumbnail"] = BatchFolder::thumbnail(mesh.name);
    }
    fs::remove_all(place, error);
    return record;
  }

  /// The repaired mesh and, of a glTF or a GIFTI, its external files: these first.
  void take_over_meshes(const BatchMesh& mesh, const fs::path& from, Record& record) {
    const std::string to = BatchFolder::mesh(mesh.name), partial = partial_place(to);
    const fs::path main = from / path_of(to).filename(), unfinished = with_infix(main, partial_infix);
    for (const fs::path& name : files_below(from)) {
      if (from / name == main || from / name == unfinished) continue;
      const std::string place = (path_of(to).parent_path() / name).generic_string();
      record["buffers"][encoded_uri(place)] = sha256_of_file(from / name);
      folder_.take_over(from / name, place);
    }
    if (folder_.take_over(unfinished, partial)) record["partial"] = as_utf8(partial);
    const std::string hash = sha256_of_file(main);
    if (!folder_.take_over(main, to)) return;
    record["output"] = as_utf8(to);
    record["output_sha256"] = hash;
  }

  static std::vector<fs::path> files_below(const fs::path& folder) {
    std::vector<fs::path> names;
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
      if (std::error_code ignored; it->is_regular_file(ignored)) names.push_back(it->path().lexically_relative(folder));
    if (error) throw_read_error(folder.string() + ": cannot list the folder", platform::errno_of(error));
    std::sort(names.begin(), names.end());
    return names;
  }

  /// The place of a partial result: beside the result, where no other mesh's result goes.
  std::string partial_place(const std::string& result) const {
    const auto is_result = [&](const fs::path& place) {
      return std::any_of(all_.begin(), all_.end(),
                         [&](const BatchMesh& mesh) { return path_of(BatchFolder::mesh(mesh.name)) == place; });
    };
    fs::path place = with_infix(path_of(result), partial_infix);
    for (int number = 2; is_result(place); ++number)
      place = with_infix(path_of(result), fmt::format("{}.{}", partial_infix, number));
    return place.generic_string();
  }

  std::vector<Record> records_of(const std::vector<BatchMesh>& meshes) const {
    std::vector<Record> records;
    for (const BatchMesh& mesh : meshes) records.push_back(record_of_mesh(mesh));
    return records;
  }

  Record record_of_mesh(const BatchMesh& mesh) const {
    if (!mesh.fault.empty()) return refused(mesh, status_invalid_input, mesh.fault);
    if (const auto unread = unread_.find(mesh.name); unread != unread_.end()) return unread->second;
    try {
      const JournalEntry* const entry = journal_.find(key_of(mesh, content_hash(mesh)));
      Record record = entry == nullptr ? Record() : Record::parse(entry->line, nullptr, false);
      return record.is_object() ? record : Record{{"mesh", as_utf8(mesh.name)}, {"status", status_pending}};
    } catch (const SystemError& error) {
      return refused(mesh, status_system_error, error.what());
    }
  }

  static std::map<std::string, std::size_t> statuses(const std::vector<Record>& records) {
    std::map<std::string, std::size_t> counts;
    for (const Record& record : records) ++counts[record["status"].get<std::string>()];
    return counts;
  }

  const BatchOptions& options_;
  Interruption& interruption_;
  BatchFolder folder_;
  Shard shard_;
  const BatchInputs inputs_;
  const std::vector<BatchMesh>& all_;
  std::vector<BatchMesh> mine_;
  std::string program_;
  BatchJournal journal_;
  BatchProgress progress_;
  std::string same_for_all_;  // the part of keys that is the same for all meshes
  std::string host_ = platform::host_name();
  int jobs_ = 1, threads_ = 1;
  double memory_limit_mb_ = 0;
  WorkerProcesses workers_;
  std::atomic<std::size_t> places_ = 0;
  std::mutex mutex_;
  std::deque<std::size_t> todo_;
  std::deque<Task> late_;
  std::map<std::string, Record> unread_;  // of meshes that the system gave no bytes of
  std::exception_ptr error_;
};

}  // namespace

void add_batch_options(CLI::App& command, BatchOptions& options) {
  command
      .add_option("LIST|FOLDER", options.input,
                  "Folder with meshes (also in its subfolders), or a text file with the path of one mesh per line and, "
                  "after a tab, the name of its result if it differs. '-': the list comes from standard input")
      ->required();
  command.add_option("OPTIONS_OF_FIX", options.fix_options,
                     "After '--': options of 'unsnarl fix', used for every mesh");
  command.add_option("-o,--output", options.output, "Folder for the results")->type_name("OUTDIR")->required();
  command
      .add_option("--jobs,-j", options.jobs,
                  "Number of meshes to repair at the same time. 0 (default): as many as there are processors")
      ->check(whole_number_within(0, 1024))
      ->type_name("N");
  command
      .add_option("--threads", options.threads,
                  "Number of threads for each mesh. 0 (default): the processors divided by --jobs")
      ->check(whole_number_within(0, 1024))
      ->type_name("N");
  command
      .add_option(
          "--shard", options.shard,
          "Repair only part I of N (I from 0 to N-1): every N-th mesh by name. Several parts may run at the same "
          "time with the same OUTDIR. Default in a Slurm array: the task")
      ->type_name("I/N");
  command.add_flag(
      "--summary", options.summary,
      "Only write the summary of what is done. Needed with --shard; else the summary is written at the end");
  command.add_flag("--thumbnails", options.thumbnails, "Draw each mesh before and after for the summary page");
  command.add_flag("--retry", options.retry,
                   "Repair again the meshes that did not end as embedded, allowed, obstructed or gap_not_met");
  const std::string limits = "Limits for each mesh";
  command
      .add_option("--time-limit", options.time_limit_s,
                  "Stop a mesh after this many seconds (default 3600). 0: no limit")
      ->check(not_negative(unit::seconds))
      ->type_name("SECONDS")
      ->group(limits);
  command
      .add_option("--memory-limit", options.memory_limit_mb,
                  "Stop a mesh before it uses more than this many MB (default: 90 % of the memory, divided by --jobs)")
      ->check(not_negative(unit::megabytes))
      ->type_name("MB")
      ->group(limits);
  command
      .add_option("--attempts", options.attempts,
                  "How often a mesh is tried if its process dies, or the whole batch with it (1 to 100, default 3)")
      ->check(whole_number_within(1, 100))
      ->type_name("N")
      ->group(limits);
  command.add_option("--worker", options.worker, "Program to run instead of this 'unsnarl'")->type_name("PROGRAM");
  add_quiet(command, options.quiet);
  command.footer(std::string("Examples:\n"
                             "  unsnarl batch scans -o repaired\n"
                             "  unsnarl batch list.txt -o repaired --jobs 8 --thumbnails -- --max-displacement 0.01\n"
                             "  # one of a hundred parts, each on its own machine; then the summary\n"
                             "  unsnarl batch scans -o repaired --shard 3/100\n"
                             "  unsnarl batch scans -o repaired --summary\n\n"
                             "Run the same command again to continue after an interruption, a crash or a power cut: "
                             "meshes that are done are "
                             "skipped.\n\n") +
                 exit_codes({{exit_embedded, "all meshes are embedded (no self-intersections)"},
                             {exit_intersecting, "all were tried, but not all are embedded; results.csv says why"},
                             {exit_allowed, "all are embedded but for pairs that --allow lets pass"},
                             {exit_gap_not_met, "all are embedded, but gaps are smaller than --min-gap asks"}}));
}

int run_batch(const BatchOptions& options, Interruption& interruption) {
  return Batch(options, interruption).run();
}

}  // namespace unsnarl::app
