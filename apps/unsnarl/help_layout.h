#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <string_view>

namespace unsnarl::app {

/// The text in lines of at most `width` characters, broken at blanks; longer words stay whole. Each line but the first
/// begins with `indent` blanks, which count. `column`: where the first line begins.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent, std::size_t column);

/// Characters in a line of help: $COLUMNS, else those of the terminal, else 80; between 40 and 100.
std::size_t help_width();

/// Help whose descriptions are wrapped. Lines that begin with a blank stay as they are.
class HelpLayout : public CLI::Formatter {
 public:
  explicit HelpLayout(std::size_t width = help_width());
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_footer(const CLI::App* app) const override;

 private:
  std::string entry(const std::string& head, const std::string& meaning) const;

  std::size_t width_;
};

}  // namespace unsnarl::app
