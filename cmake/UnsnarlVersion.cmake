# Version and address of the project, from the one place that has them: project.json. "version" is "major.minor.patch", with
# ".dev" behind it until it is released; "homepage" is the URL where the project lives, empty while it has none.
set(place ${CMAKE_CURRENT_LIST_DIR}/project.json)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${place})
file(READ ${place} about)
string(JSON UNSNARL_VERSION GET "${about}" version)
string(JSON UNSNARL_HOMEPAGE GET "${about}" homepage)
if(NOT UNSNARL_VERSION MATCHES "^([0-9]+\\.[0-9]+\\.[0-9]+)(\\.dev)?$")
  message(FATAL_ERROR "${place}: the version '${UNSNARL_VERSION}' is neither 1.2.3 nor 1.2.3.dev")
endif()
set(UNSNARL_VERSION_NUMBER ${CMAKE_MATCH_1})  # what CMake and file names of libraries take
