#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>
#include <vector>

#include "batch/batch.h"
#include "check.h"
#include "curves.h"
#include "fix.h"
#include "help_layout.h"
#include "interruption.h"
#include "isotopy.h"
#include "knot_isotopy.h"
#include "memory_guard.h"
#include "platform/files.h"
#include "platform/terminal.h"
#include "routes.h"
#include "sample.h"
#include "seifert.h"
#include "standard_streams.h"
#include "unsnarl/document.h"
#include "unsnarl/exit_code.h"
#include "unsnarl/limit_reached.h"
#include "unsnarl/repair.h"
#include "unsnarl/threads.h"
#include "unsnarl/version.h"
#include "unsnarl/visible_text.h"
#include "usage.h"
#include "usage_error.h"
#include "version.h"
#include "view.h"

namespace unsnarl::app {
namespace {

ExitCode complain(ExitCode code, std::string_view what) {
  tell(fmt::format("unsnarl: {}\n", visible_text(what)));
  return code;
}

int run(int argc, char** argv) {
  Interruption interruption;
  CLI::App program(
      "Removes self-intersections from surface meshes. Only vertex positions change, and as little as possible; faces, "
      "texture coordinates and everything else in the file stay the same. The written file is read back and checked "
      "with exact arithmetic.",
      "unsnarl");
  bool as_json = false;
  program.add_flag("--json", as_json, "With --version: print JSON, with the versions of all libraries");
  const auto versions = [&] { return as_json ? version_json() : std::string("unsnarl ") + version; };
  program.set_version_flag("--version,-V", versions);
  program.require_subcommand(1);
  program.formatter(std::make_shared<HelpLayout>());
  FixOptions fix;
  BatchOptions batch;
  CheckOptions check;
  SampleOptions sample;
  ViewOptions view;
  CurvesOptions curves;
  SeifertCommandOptions seifert;
  IsotopyCommandOptions isotopy;
  KnotIsotopyCommandOptions knot_isotopy;
  RoutesCommandOptions routes;
  CLI::App* const fix_command = program.add_subcommand("fix", "Repair a mesh");
  CLI::App* const batch_command = program.add_subcommand("batch", "Repair many meshes, each in its own process");
  CLI::App* const check_command = program.add_subcommand("check", "Count and locate the self-intersections of a mesh");
  CLI::App* const view_command =
      program.add_subcommand("view", "Write a page for a browser that shows a mesh, before and after");
  CLI::App* const sample_command = program.add_subcommand("sample", "Make a test surface, curve, knot or plan");
  CLI::App* const curves_command =
      program.add_subcommand("curves", "Remove the crossings of curves in the plane (SVG or JSON)");
  CLI::App* const isotopy_command = program.add_subcommand(
      "isotopy", "Move closed curves in the plane to other curves without crossing (SVG or JSON)");
  CLI::App* const seifert_command =
      program.add_subcommand("seifert", "Make a surface without self-intersections whose boundary is a knot or link");
  CLI::App* const knot_isotopy_command =
      program.add_subcommand("knot-isotopy", "Move a knot in space to another one without passing through itself");
  CLI::App* const routes_command =
      program.add_subcommand("routes", "Plan routes in space that keep a distance from each other and from obstacles");
  add_fix_options(*fix_command, fix);
  add_batch_options(*batch_command, batch);
  add_check_options(*check_command, check);
  add_view_options(*view_command, view);
  add_sample_options(*sample_command, sample);
  add_curves_options(*curves_command, curves);
  add_isotopy_options(*isotopy_command, isotopy);
  add_seifert_options(*seifert_command, seifert);
  add_knot_isotopy_options(*knot_isotopy_command, knot_isotopy);
  add_routes_options(*routes_command, routes);
  for (CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    command->set_version_flag("--version", versions)->group("");  // the same for all, so not listed again
  for (CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) command->group("Commands");
  program.footer(std::string("Examples:\n"
                             "  # count and locate the self-intersections\n"
                             "  unsnarl check hand.obj\n"
                             "  # repair the mesh, and draw a picture of it before and after\n"
                             "  unsnarl fix hand.obj -o hand_fixed.obj --picture hand.png\n\n") +
                 exit_codes({{exit_embedded, "embedded: no self-intersections (check: none found)"},
                             {exit_intersecting, "self-intersections are left (check: found)"},
                             {exit_limit, "limit of time, memory or displacement reached"},
                             {exit_obstructed, "everything was repaired that can be repaired with these options"},
                             {exit_allowed, "only pairs that --allow lets pass intersect"},
                             {exit_gap_not_met, "no self-intersections, but a gap is smaller than --min-gap asks"}}) +
                 "\n\n"
                 "'unsnarl COMMAND --help' explains the options of a command.");
  const std::vector<std::string> words = with_usual_spelling(platform::command_line(argc, argv));
  try {
    program.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) return complain(exit_usage, explain_usage(program, e, words));
    program.exit(e, std::cout, std::cerr);
    return exit_embedded;
  }
  const ThreadLimit limit(*fix_command ? fix.threads : *view_command ? view.threads : check.threads);
  if (*fix_command) return run_fix(fix, interruption);
  if (*batch_command) return run_batch(batch, interruption);
  if (*check_command) return run_check(check, interruption);
  if (*view_command) return run_view(view, interruption);
  if (*curves_command) return run_curves(curves, interruption);
  if (*isotopy_command) return run_isotopy(isotopy, interruption);
  if (*seifert_command) return run_seifert(seifert, interruption);
  if (*knot_isotopy_command) return run_knot_isotopy(knot_isotopy, interruption);
  if (*routes_command) return run_routes(routes, interruption);
  return run_sample(sample, interruption);
}

/// Memory has run out: below the limit that the user set, or that of the machine. Says so without asking for any.
ExitCode complain_of_memory(std::string_view what) {
  const double limit_mb = MemoryGuard::limit_mb();
  std::array<char, 256> text;
  const auto end =
      limit_mb > 0 ? fmt::format_to_n(text.data(), text.size(),
                                      "unsnarl: {} MB are not enough for this mesh; raise --memory-limit\n", limit_mb)
                   : fmt::format_to_n(text.data(), text.size(), "unsnarl: {}\n", what);
  draw({text.data(), std::min(end.size, text.size())});
  return limit_mb > 0 ? exit_limit : exit_system_error;
}

/// TBB says it in words only.
bool is_about_threads(const std::exception& e) {
  return std::string_view(e.what()).starts_with("pthread_create");
}

/// Every error ends here: says the reason of the one that is being handled, returns its exit code.
ExitCode explain_error() {
  try {
    throw;
  } catch (const UsageError& e) {
    return complain(exit_usage, e.what());
  } catch (const GapTooWide& e) {
    return complain(exit_usage, fmt::format("--min-gap: {} (--absolute)", e.what()));
  } catch (const FileError& e) {
    return complain(exit_invalid_input, e.what());
  } catch (const WriteError& e) {
    return complain(exit_cannot_write, e.what());
  } catch (const SystemError& e) {
    return complain(exit_system_error, e.what());
  } catch (const LimitReached& e) {
    const std::string_view option = e.status() == Status::memory_limit ? "--memory-limit" : "--time-limit";
    return complain(exit_limit, fmt::format("{}; raise {}", e.what(), option));
  } catch (const std::bad_alloc&) {
    return complain_of_memory("not enough memory");
  } catch (const std::exception& e) {
    const auto* const system = dynamic_cast<const std::system_error*>(&e);
    if (is_about_threads(e) || (system && system->code() == std::errc::resource_unavailable_try_again))
      return complain_of_memory("not enough memory to start threads; --threads 1 needs the least");
    if (system && is_error_of_system(platform::errno_of(system->code()))) return complain(exit_system_error, e.what());
    return complain(exit_internal_error, fmt::format("internal error: {}. {}", e.what(), advice_on_defects(homepage)));
  }
}

/// The handler of errors that nothing catches (in a thread that has just run out of memory, say).
[[noreturn]] void explain_and_end() {
  Interruption::end_process(std::current_exception() ? explain_error() : exit_internal_error);
}

}  // namespace
}  // namespace unsnarl::app

int main(int argc, char** argv) {
  using namespace unsnarl::app;
  unsnarl::platform::prepare_standard_streams();
  std::set_terminate(explain_and_end);
  try {
    return run(argc, argv);
  } catch (...) {
    return explain_error();
  }
}
