#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "batch/worker_process.h"

namespace unsnarl::app {

/// Record of a mesh: a flat JSON object of names and numbers that follow from the mesh, the options and the
/// program alone, and under "run" what does not (seconds, memory, ...).
using Record = nlohmann::ordered_json;

/// The columns of results.csv and of the page, in this order: keys of a record.
const std::vector<std::string>& record_columns();

/// Statuses beside those of repairs (to_string(Status)): the mesh has not been worked on yet; the worker ended with an
/// error; was killed, or died; the batch itself ended again and again while the mesh was worked on.
inline constexpr const char* status_pending = "pending";
inline constexpr const char* status_invalid_input = "invalid_input";
inline constexpr const char* status_cannot_write = "cannot_write";
inline constexpr const char* status_system_error = "system_error";
inline constexpr const char* status_usage_error = "usage_error";
inline constexpr const char* status_internal_error = "internal_error";
inline constexpr const char* status_killed = "killed";
inline constexpr const char* status_ended_the_batch = "ended_the_batch";

/// A name for a record: itself, or where it is no text what can be read of it.
std::string as_utf8(const std::string& name);

/// The record of a mesh from how its worker ended, its report and what it said; either file may be missing.
/// Throws SystemError.
Record record_of(const std::string& mesh, const WorkerEnd& end, const std::filesystem::path& report,
                 const std::filesystem::path& standard_error);

}  // namespace unsnarl::app
