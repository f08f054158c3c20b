#include "help_layout.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <sstream>

#include "platform/terminal.h"

namespace unsnarl::app {
namespace {

constexpr std::size_t usual_width = 80, least_width = 40, most_width = 100;
constexpr std::size_t meaning_column = 28;  // characters; heads that reach it stand on a line of their own

/// Characters of UTF-8 text.
std::size_t length(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::size_t width_of_environment() {
  const char* const given = std::getenv("COLUMNS");
  if (given == nullptr) return 0;
  std::size_t width = 0;
  const std::string_view text = given;
  std::from_chars(text.data(), text.data() + text.size(), width);
  return width;
}

std::string value_of(const CLI::Option& option) {
  if (option.get_type_size() == 0 || option.get_type_name().empty() || option.get_type_name() == "TEXT") return {};
  return " " + option.get_type_name();
}

/// "-o OUT", as on a command line.
std::string with_value(const CLI::Option& option) {
  const std::vector<std::string>& letters = option.get_snames();
  return (letters.empty() ? "--" + option.get_lnames().front() : "-" + letters.front()) + value_of(option);
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent, std::size_t column) {
  std::istringstream words{std::string(text)};
  std::string lines;
  bool is_at_start = true;
  for (std::string word; words >> word; is_at_start = false) {
    if (!is_at_start && column + 1 + length(word) > width) {
      lines += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (!is_at_start) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += length(word);
  }
  return lines;
}

std::size_t help_width() {
  std::size_t width = width_of_environment();
  if (width == 0) width = platform::terminal_width();
  if (width == 0) width = usual_width;
  return std::clamp(width, least_width, most_width);
}

HelpLayout::HelpLayout(std::size_t width) : width_(width) {
  label("Positionals", "Arguments");
}

std::string HelpLayout::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  // Groups end with an empty line and begin with another.
  return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, std::move(name), mode), "\n\n\n", "\n\n");
}

std::string HelpLayout::make_description(const CLI::App* app) const {
  return wrapped(app->get_description(), width_, 0, 0) + "\n";
}

std::string HelpLayout::make_usage(const CLI::App* app, std::string name) const {
  std::string usage = "Usage: " + name + (app->get_subcommands({}).empty() ? " [OPTIONS]" : " [OPTIONS] COMMAND");
  for (const CLI::Option* option : app->get_options())
    if (option->nonpositional() && option->get_required()) usage += " " + with_value(*option);
  for (const CLI::Option* option : app->get_options([](const CLI::Option* any) { return any->get_positional(); }))
    usage += " " + make_option_usage(option);
  return usage + "\n";
}

std::string HelpLayout::make_subcommand(const CLI::App* command) const {
  return entry(command->get_display_name(true), command->get_description());
}

std::string HelpLayout::make_option(const CLI::Option* option, bool is_positional) const {
  const bool is_list = option->get_expected_max() == CLI::detail::expected_max_vector_size;
  return entry(make_option_name(option, is_positional) + value_of(*option) + (is_list ? " ..." : ""),
               option->get_description());
}

std::string HelpLayout::make_footer(const CLI::App* app) const {
  std::istringstream lines(app->get_footer());
  std::string footer;
  for (std::string line; std::getline(lines, line);)
    footer += (line.starts_with(' ') ? line : wrapped(line, width_, 0, 0)) + "\n";
  return footer;
}

std::string HelpLayout::entry(const std::string& head, const std::string& meaning) const {
  std::string text = "  " + head;
  if (length(text) + 2 > meaning_column)
    text += "\n" + std::string(meaning_column, ' ');
  else
    text += std::string(meaning_column - length(text), ' ');
  return text + wrapped(meaning, width_, meaning_column, meaning_column) + "\n";
}

}  // namespace unsnarl::app
