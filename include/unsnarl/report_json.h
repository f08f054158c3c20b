#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/check.h"
#include "unsnarl/clearance.h"
#include "unsnarl/nesting.h"
#include "unsnarl/parts.h"
#include "unsnarl/repair.h"
#include "unsnarl/report.h"
#include "unsnarl/scene_document.h"
#include "unsnarl/surface.h"

namespace unsnarl {

struct FrameReport;

/// Raised whenever a key is renamed, removed or changes its meaning; new keys do not raise it.
inline constexpr int report_schema_version = 2;     ///< of report_json, see docs/report.md
inline constexpr int recording_schema_version = 2;  ///< of recording_json, see docs/recording.md
inline constexpr int check_schema_version = 1;      ///< of check_json

/// The files and the time around a call, as reports list them.
struct ReportFiles {
  std::string input, output;            ///< paths; empty: arrays or several files were given, none was written
  std::vector<std::string> partial;     ///< paths of what an unfinished repair reached; empty: none was written
  std::string format;                   ///< of the input: "obj", ...; empty: arrays or several files were given
  std::size_t vertices = 0, faces = 0;  ///< as the file counts them
  std::vector<std::string> notes;       ///< Document::notes
  std::vector<NamedPart> parts;         ///< that the files name; check_json alone lists them
  SceneReport scene;                    ///< empty: one file or mesh was given
  std::vector<NestedPair> nested;       ///< what was to lie inside what; empty: nothing was
  std::vector<StageReport> before_repair, after_repair;        ///< reading, writing
  std::optional<Clearance> clearance_before, clearance_after;  ///< of the files read; none: not measured
  StageReport whole;                                           ///< all of it; its name is not used
};

/// The report of `unsnarl fix` as JSON, indented, without a line break at the end. Keys are the names of the fields of
/// RepairReport. Holds the history where `options.record` asks for it. Bytes that are not UTF-8 become U+FFFD.
std::string report_json(const RepairResult& result, const RepairOptions& options, const ReportFiles& files = {});

/// History and frames of a repair of `surface` as JSON in one line, without a line break at the end.
std::string recording_json(const RepairResult& result, const SurfaceView& surface);

/// The findings of `unsnarl check --json` as JSON, indented, without a line break at the end; with every place. Of
/// `files` it uses input, format, vertices, faces, notes, parts and scene.
std::string check_json(const CheckReport& found, Goal goal, const FindOptions& options, const ReportFiles& files = {});

/// The report of a frame of a sequence as JSON in one line: a line of the list in docs/sequences.md.
std::string frame_json(const FrameReport& frame);

/// Intersecting pairs as all reports count them: {"total": ..., "by_class": {"disjoint": ..., ...}}.
std::string pairs_json(const PairCounts& counts);

/// The status that reports call so; none: it is no status of a repair.
std::optional<Status> status_from_name(std::string_view name);

/// Names of options, as reports and the command line use them.
std::string_view to_string(Weld weld);
std::string_view to_string(Goal goal);

}  // namespace unsnarl
