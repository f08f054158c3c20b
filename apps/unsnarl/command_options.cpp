#include "command_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "standard_streams.h"
#include "unsnarl/document.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/parts.h"
#include "unsnarl/paths.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

constexpr double unbounded = std::numeric_limits<double>::max();

std::optional<double> number_in(const std::string& text) {
  double number = 0;
  if (!CLI::detail::lexical_cast(text, number) || std::isnan(number)) return std::nullopt;
  return number;
}

/// Why this is not a number: a decimal comma, a unit, a percent sign.
std::string fault_of_text(const std::string& text) {
  std::string other = text;
  std::replace(other.begin(), other.end(), ',', '.');
  if (other != text && number_in(other))
    return fmt::format("'{}' is not a number; use a decimal point: {}", text, other);
  if (text.ends_with('%'))
    if (const auto percent = number_in(text.substr(0, text.size() - 1)))
      return fmt::format("'{}' is not a number; {} is {:.6g}", text, text, *percent / 100);
  return fmt::format("'{}' is not a number", text);
}

/// `bound`: the fault of a number that is too large; empty: it is not.
template <class Bound>
CLI::Validator number_from(double least, Unit unit, const Bound& bound) {
  const auto fault = [=](const std::string& text) {
    const std::optional<double> number = number_in(text);
    const std::string words = !number           ? fault_of_text(text)
                              : *number < least ? fmt::format("'{}' is less than {}", text, least)
                                                : bound(text, *number);
    return words.empty() ? std::string() : fmt::format("{}; {}", unit.words, words);
  };
  return CLI::Validator(fault, "");
}

/// "'a', 'b' or 'c'".
std::string quoted(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += fmt::format("{}'{}'", k == 0 ? "" : k + 1 == words.size() ? " or " : ", ", words[k]);
  return text;
}

}  // namespace

CLI::Validator one_of(std::vector<std::string> words) {
  const auto fault = [words = std::move(words)](const std::string& text) {
    if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
    return fmt::format("must be {}, not '{}'", quoted(words), text);
  };
  return CLI::Validator(fault, "");
}
CLI::Validator number_within(double least, double most, Unit unit) {
  return number_from(least, unit, [most](const std::string& text, double number) {
    if (number <= most) return std::string();
    return most == unbounded ? fmt::format("'{}' is infinite", text) : fmt::format("'{}' is more than {}", text, most);
  });
}
CLI::Validator number_below(double least, double bound, Unit unit) {
  return number_from(least, unit, [bound](const std::string& text, double number) {
    return number < bound ? std::string() : fmt::format("'{}' is not less than {}", text, bound);
  });
}
CLI::Validator not_negative(Unit unit) {
  return number_within(0, unbounded, unit);
}
CLI::Validator whole_number_within(std::int64_t least, std::int64_t most) {
  const auto fault = [least, most](const std::string& text) {
    std::int64_t number = 0;
    if (CLI::detail::lexical_cast(text, number) && number >= least && number <= most) return std::string();
    return most == std::numeric_limits<std::int32_t>::max()
               ? fmt::format("must be a whole number, {} or more, not '{}'", least, text)
               : fmt::format("must be a whole number from {} to {}, not '{}'", least, most, text);
  };
  return CLI::Validator(fault, "");
}

CLI::Validator file_named(std::vector<std::string> extensions, bool folders, const std::string& advice) {
  const auto fault = [=](const std::string& path) {
    if (is_stream(path) || path.ends_with('/')) return std::string();
    std::error_code ignored;
    if (folders && std::filesystem::is_directory(path_of(path), ignored)) return std::string();
    std::string extension = CLI::detail::to_lower(path_of(path).extension().string());
    extension.erase(0, 1);
    if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) return std::string();
    return fmt::format("must be named *.{}, not '{}'{}", fmt::join(extensions, " or *."), path,
                       advice.empty() ? "" : fmt::format("; {}", advice));
  };
  return CLI::Validator(fault, "");
}

std::string exit_codes(std::map<int, std::string> own) {
  own.merge(std::map<int, std::string>{{exit_usage, "usage error"},
                                       {exit_invalid_input, "cannot read the input"},
                                       {exit_cannot_write, "cannot write the output"},
                                       {exit_cancelled, "interrupted"},
                                       {exit_system_error, "the system failed; the same command may succeed later"},
                                       {exit_internal_error, "internal error: a bug in unsnarl"}});
  std::string text = "Exit codes:";
  for (const auto& [code, meaning] : own) text += fmt::format("\n  {:<4}{}", code, meaning);
  return text;
}

void add_time_limit(CLI::App& command, double& limit, const std::string& group) {
  command.add_option("--time-limit", limit, "Stop after this many seconds. 0: no limit")
      ->check(not_negative(unit::seconds))
      ->type_name("SECONDS")
      ->group(group);
}

void add_memory_limit(CLI::App& command, double& limit, const std::string& group) {
  command.add_option("--memory-limit", limit, "Stop before the program uses more than this many MB. 0: no limit")
      ->check(not_negative(unit::megabytes))
      ->type_name("MB")
      ->group(group);
}

void add_progress(CLI::App& command, std::string& progress, const std::string& group) {
  command
      .add_option("--progress", progress,
                  "Progress on standard error. 'auto' (default): one line that is updated on a terminal, else a line "
                  "every 30 seconds. 'json': JSON lines. 'none': no progress")
      ->check(one_of({"auto", "json", "none"}))
      ->type_name("auto|json|none")
      ->group(group);
}

void add_quiet(CLI::App& command, bool& quiet, const std::string& group) {
  command.add_flag("--quiet,-q", quiet, "Print errors only")->group(group);
}

void add_inputs(CLI::App& command, MeshOptions& options, const std::string& input) {
  command.add_option("IN", options.inputs, input + ": " + format_names(" or ") + "; '-' for standard input")
      ->required();
}

void add_mesh_options(CLI::App& command, MeshOptions& options) {
  command.add_option("--threads", options.threads, "Number of threads. 0: all processors")
      ->check(whole_number_within(0, 1024))
      ->type_name("N");
  add_quiet(command, options.quiet);
  const std::string reading = options_of_reading;
  command
      .add_option("--format", options.format,
                  "File format, if the name does not show it (with several files: of all of them)")
      ->type_name("FORMAT")
      ->group(reading);
  command
      .add_option("--goal", options.goal,
                  "Which self-intersections count. 'all' (default): two faces that touch anywhere except at the "
                  "vertices and edges that they share. 'disjoint': only faces that share no vertex")
      ->check(one_of({"all", "disjoint"}))
      ->type_name("all|disjoint")
      ->group(reading);
  command
      .add_option("--weld", options.weld,
                  "Treat vertices at the same position as one: only along UV seams and STL corners ('seams', default), "
                  "'all', or 'none'. The file itself is never merged")
      ->check(one_of({"none", "seams", "all"}))
      ->type_name("none|seams|all")
      ->group(reading);
  command
      .add_option("--weld-tolerance", options.weld_tolerance,
                  "Largest distance between positions that count as the same, in the units of the file (default 0)")
      ->check(not_negative(unit::units_of_file))
      ->type_name("LENGTH")
      ->group(reading);
  command
      .add_flag("--both-diagonals", options.both_diagonals,
                "Test both ways to split a quad into triangles: the result holds whichever way another program splits "
                "it. Default: split from the first corner (from the second if the first would fold)")
      ->group(reading);
  command.final_callback([&options] { options.require_effect(); });
}

void MeshOptions::require_effect() const {
  if (weld == "none" && weld_tolerance > 0)
    throw UsageError("--weld-tolerance has no effect with --weld none; leave one of the two out");
}

FindOptions MeshOptions::find() const {
  FindOptions result;
  result.weld = weld == "none" ? Weld::none : weld == "all" ? Weld::all : Weld::seams;
  result.weld_tolerance = weld_tolerance;
  result.both_diagonals = both_diagonals;
  result.threads = threads;
  return result;
}

FindOptions MeshOptions::find_in(const SceneDocument& scene) const {
  FindOptions result = find();
  try {
    result.allowed = allowed_pairs(scene.surface(), scene.face_labels(), allow, result);
  } catch (const std::invalid_argument& wrong) {
    throw UsageError(fmt::format("--allow: {}", wrong.what()));
  }
  return result;
}

void add_allow(CLI::App& command, std::vector<std::string>& allow, const std::string& group) {
  command
      .add_option(
          "--allow", allow,
          "Let the faces of A and B pass through each other; A alone: let A intersect itself. A and B are names "
          "of files, objects, groups or materials, or numbers of components in the list of 'unsnarl check'; "
          "object=A, group=A, material=A, component=A or file=A says which. Such pairs are counted apart (exit "
          "code 8). May be repeated")
      ->type_name("A[:B]")
      ->group(group)
      ->allow_extra_args(false);
}

}  // namespace unsnarl::app
