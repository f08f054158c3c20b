# Makes a C++ source of a page: cmake -DPAGE=... -DSOURCE=... -DHEADER=... -DFUNCTION=... -P this. The header declares
# the function, named with its namespace, which returns the page.
file(READ ${PAGE} text)
string(FIND "${text}" ")unsnarl_page\"" clash)
if(NOT clash EQUAL -1)
  message(FATAL_ERROR "${PAGE} contains what ends the string literal")
endif()
file(WRITE ${SOURCE} "#include \"${HEADER}\"

#include <string_view>

std::string_view ${FUNCTION}() {
  using namespace std::string_view_literals;
  return R\"unsnarl_page(${text})unsnarl_page\"sv;
}
")
