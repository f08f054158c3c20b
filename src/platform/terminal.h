#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace unsnarl::platform {

/// Makes the standard streams fit for use: what is written is what comes out, byte by byte. In place of those that were
/// closed at the start it opens what holds nothing and takes everything; but standard output, where writing then
/// fails, so that no result is lost without a word. Else a file opened later would take their number, and what is meant
/// for a person would end up in it. To be called first.
void prepare_standard_streams();

/// The words of the command line behind the program's name, as UTF-8 where they are text.
std::vector<std::string> command_line(int argc, char** argv);

bool is_terminal_of_standard_error();
/// Characters in a line of the terminal of standard output; 0: it is none.
std::size_t terminal_width();

}  // namespace unsnarl::platform
