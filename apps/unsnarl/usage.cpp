#include "usage.h"

#include <fmt/format.h>

#include <filesystem>

#include "suggestions.h"

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
  std::string text = "say what to do: ";
  for (const std::string& name : names)
    text += name == names.front() ? name : name == names.back() ? " or " + name : ", " + name;
  const std::string given = words.empty() ? std::string() : words.front();
  std::vector<std::string> names_and_options = names;
  names_and_options.insert(names_and_options.end(), {"--version", "--help"});
  std::error_code ignored;
  if (!given.empty() && given[0] != '-') {
    if (std::filesystem::exists(given, ignored))
      text += fmt::format("; with a mesh, 'unsnarl check {0}' or 'unsnarl fix {0} -o OUT'", given);
    else
      text = fmt::format("there is no command '{}'{}; {}", given, did_you_mean(given, names_and_options), text);
  }
  return text + "; 'unsnarl --help' explains";
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
  const std::string help = fmt::format("; 'unsnarl {} --help' explains", name);
  const std::vector<std::string> options = option_names(command);
  for (const std::string& word : words) {
    if (word == "--") break;
    const std::string given = word.substr(0, word.find('='));
    if (!given.starts_with("--") || command.get_option_no_throw(given) != nullptr) continue;
    const bool is_for_fix = name == "batch" && program.get_subcommand("fix")->get_option_no_throw(given) != nullptr;
    const std::string advice = is_for_fix ? "; options of 'unsnarl fix' go after '--'" : did_you_mean(given, options);
    return fmt::format("'unsnarl {}' has no option {}{}", name, given, advice) + help;
  }
  return error.what() + help;
}

}  // namespace unsnarl::app
