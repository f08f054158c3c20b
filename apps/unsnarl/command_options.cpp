#include "command_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "standard_streams.h"
#include "unsnarl/document.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

/// `reaches`: whether a number is no larger than allowed, which the message says in `words` and with `most`.
template <class Reaches>
CLI::Validator number_in(double least, double most, const Reaches& reaches, const char* words) {
  // CLI::Range lets NaN through, which is on no side of any bound.
  const auto fault = [=](const std::string& text) {
    double number = 0;
    if (CLI::detail::lexical_cast(text, number) && number >= least && reaches(number)) return std::string();
    const std::string hint = text.ends_with('%') && CLI::detail::lexical_cast(text.substr(0, text.size() - 1), number)
                                 ? fmt::format("; {} is {:.6g}", text, number / 100)
                                 : "";
    return most == std::numeric_limits<double>::max()
               ? fmt::format("{} is no number from {} up{}", text, least, hint)
               : fmt::format("{} is no number from {} {} {}{}", text, least, words, most, hint);
  };
  return CLI::Validator(fault, "");
}

}  // namespace

CLI::Validator one_of(std::vector<std::string> words) {
  return CLI::IsMember(std::move(words)).description("");
}
CLI::Validator number_within(double least, double most) {
  return number_in(
      least, most, [=](double number) { return number <= most; }, "to");
}
CLI::Validator number_below(double least, double bound) {
  return number_in(
      least, bound, [=](double number) { return number < bound; }, "to less than");
}
CLI::Validator not_negative() {
  return number_within(0, std::numeric_limits<double>::max());
}
CLI::Validator whole_number_within(long least, long most) {
  const auto fault = [least, most](const std::string& text) {
    long number = 0;
    if (CLI::detail::lexical_cast(text, number) && number >= least && number <= most) return std::string();
    return fmt::format("{} is no whole number from {} to {}", text, least, most);
  };
  return CLI::Validator(fault, "");
}

CLI::Validator file_named(std::vector<std::string> extensions, bool folders, const std::string& advice) {
  const auto fault = [=](const std::string& path) {
    if (is_stream(path) || path.ends_with('/')) return std::string();
    std::error_code ignored;
    if (folders && std::filesystem::is_directory(path, ignored)) return std::string();
    std::string extension = CLI::detail::to_lower(std::filesystem::path(path).extension().string());
    extension.erase(0, 1);
    if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) return std::string();
    return fmt::format("{}: name it *.{}{}", path, fmt::join(extensions, " or *."),
                       advice.empty() ? "" : fmt::format("; {}", advice));
  };
  return CLI::Validator(fault, "");
}

void add_time_limit(CLI::App& command, double& seconds, const std::string& group) {
  command.add_option("--time-limit", seconds, "Stop after this many seconds; 0: none")
      ->check(not_negative())
      ->type_name("S")
      ->group(group);
}

void add_memory_limit(CLI::App& command, double& megabytes, const std::string& group) {
  command.add_option("--memory-limit", megabytes, "Stop before the program holds more than this many MB; 0: none")
      ->check(not_negative())
      ->type_name("MB")
      ->group(group);
}

void add_progress(CLI::App& command, std::string& progress, const std::string& group) {
  command
      .add_option("--progress", progress,
                  "On standard error: one line that changes, or if it is no terminal a line each 30 seconds\n"
                  "('auto', default); JSON lines; or 'none'")
      ->check(one_of({"auto", "json", "none"}))
      ->type_name("auto|json|none")
      ->group(group);
}

void add_quiet(CLI::App& command, bool& quiet, const std::string& group) {
  command.add_flag("--quiet,-q", quiet, "Say nothing but errors")->group(group);
}

void add_mesh_options(CLI::App& command, MeshOptions& options, const std::string& input) {
  command.add_option("IN", options.inputs, input + ": " + format_names(" or ") + "; '-' for standard input")
      ->required();
  command
      .add_option("--format", options.format, "Format of the mesh, where its name does not tell; of several, of each")
      ->type_name("FORMAT");
  command
      .add_option("--goal", options.goal,
                  "What counts as a self-intersection: 'all' (default), pairs of faces that meet anywhere\n"
                  "but where they are joined; or only the 'disjoint' ones of these, which share no vertex")
      ->check(one_of({"all", "disjoint"}))
      ->type_name("all|disjoint");
  command
      .add_option("--weld", options.weld,
                  "Which vertices at equal positions count as one: 'seams', ends of open edges that coincide\n"
                  "(default: texture seams, corners in STL), 'all', or 'none'. The file keeps them apart anyway")
      ->check(one_of({"none", "seams", "all"}))
      ->type_name("none|seams|all");
  command
      .add_option("--weld-tolerance", options.weld_tolerance,
                  "How far apart positions may be to count as equal, in the units of the mesh")
      ->check(not_negative())
      ->type_name("LENGTH");
  command.add_flag("--both-diagonals", options.both_diagonals,
                   "Programs that read the file may split quads along either diagonal: faces intersect where they do\n"
                   "for any choice. Else a quad is split from its first corner (or its second, if that folds)");
  command.add_option("--threads", options.threads, "Threads to use; 0: as many as the machine has")
      ->check(whole_number_within(0, 1024))
      ->type_name("N");
  add_quiet(command, options.quiet);
  command.final_callback([&options] { options.require_effect(); });
}

void MeshOptions::require_effect() const {
  if (weld == "none" && weld_tolerance > 0)
    throw UsageError("--weld-tolerance does nothing with --weld none; leave one of the two out");
}

FindOptions MeshOptions::find() const {
  FindOptions result;
  result.weld = weld == "none" ? Weld::none : weld == "all" ? Weld::all : Weld::seams;
  result.weld_tolerance = weld_tolerance;
  result.both_diagonals = both_diagonals;
  result.threads = threads;
  return result;
}

}  // namespace unsnarl::app
