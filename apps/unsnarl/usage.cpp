#include "usage.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "suggestions.h"
#include "unsnarl/paths.h"

namespace unsnarl::app {
namespace {

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back(fmt::format("--{}", name));
  return names;
}

std::string explain_missing_command(const CLI::App& program, const std::vector<std::string>& words) {
  const std::vector<std::string> names = command_names(program);
  const std::string commands = fmt::format(" Commands: {}. 'unsnarl --help' explains them.", fmt::join(names, ", "));
  const std::string given = words.empty() ? std::string() : words.front();
  if (given.empty() || given[0] == '-') return "No command was given." + commands;
  std::error_code ignored;
  if (std::filesystem::exists(path_of(given), ignored))
    return fmt::format("'{0}' is a file, not a command. Use 'unsnarl check {0}' or 'unsnarl fix {0} -o OUT'.", given) +
           commands;
  std::vector<std::string> names_and_options = names;
  names_and_options.insert(names_and_options.end(), {"--version", "--help"});
  return fmt::format("Unknown command '{}'.{}", given, did_you_mean(given, names_and_options)) + commands;
}

/// "-o" for "--output", as people type it.
std::string usual_name(const CLI::Option& option) {
  return option.get_snames().empty() ? option.get_name() : "-" + option.get_snames().front();
}

std::string explain_missing_value(const CLI::App& command, const std::string& name) {
  const CLI::Option* const option = command.get_option_no_throw(name);
  if (option == nullptr) return name + " needs a value";
  const std::string usual = usual_name(*option), type = option->get_type_name();
  if (type == "OUT") return fmt::format("{0} needs a file name, as in {0} out.obj", usual);
  if (type == "DIR") return fmt::format("{0} needs the name of a folder, as in {0} results", usual);
  return fmt::format("{0} needs a value: {0} {1}", usual, type);
}

/// "-o" for "--output", if there is such an option.
std::string as_written(const CLI::App& command, const std::string& name) {
  const CLI::Option* const option = command.get_option_no_throw(name);
  return option == nullptr ? name : usual_name(*option);
}

/// "-o DIR" for "--output".
std::string as_typed(const CLI::App& command, const std::string& name) {
  const CLI::Option* const option = command.get_option_no_throw(name);
  if (option == nullptr || !option->nonpositional()) return name;
  return usual_name(*option) + " " + option->get_type_name();
}

/// A fault that the parser found, as a sentence without its full stop.
std::string explain_fault(const CLI::App& command, const CLI::ParseError& error) {
  const std::string fault = error.what(), kind = error.get_name();
  const std::string name = fault.substr(0, fault.find_first_of(": "));
  if (kind == "ValidationError")
    return fmt::format("{} {}", as_written(command, name), fault.substr(std::min(fault.size(), name.size() + 2)));
  if (kind == "ArgumentMismatch") return explain_missing_value(command, name);
  if (kind == "RequiredError") return fmt::format("'unsnarl {}' needs {}", command.get_name(), as_typed(command, name));
  if (kind == "RequiresError") return fmt::format("{} needs {}", name, fault.substr(fault.rfind(' ') + 1));
  if (kind == "ExcludesError")
    return fmt::format("{} and {} exclude each other; leave one of the two out", name,
                       fault.substr(fault.rfind(' ') + 1));
  return fault;
}

}  // namespace

std::vector<std::string> with_usual_spelling(std::vector<std::string> words) {
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.push_back("--help");
  return words;
}

std::string explain_usage(const CLI::App& program, const CLI::ParseError& error,
                          const std::vector<std::string>& words) {
  if (program.get_subcommands().empty()) return explain_missing_command(program, words);
  const CLI::App& command = *program.get_subcommands().front();
  const std::string name = command.get_name();
  const std::string help = fmt::format(" 'unsnarl {} --help' lists all options.", name);
  const std::vector<std::string> options = option_names(command);
  for (const std::string& word : words) {
    if (word == "--") break;
    const std::string given = word.substr(0, word.find('='));
    if (!given.starts_with("--") || command.get_option_no_throw(given) != nullptr) continue;
    const bool is_for_fix = name == "batch" && program.get_subcommand("fix")->get_option_no_throw(given) != nullptr;
    const std::string advice = is_for_fix ? " Options of 'unsnarl fix' go after '--'." : did_you_mean(given, options);
    return fmt::format("'unsnarl {}' has no option {}.{}", name, given, advice) + help;
  }
  return explain_fault(command, error) + "." + help;
}

}  // namespace unsnarl::app
