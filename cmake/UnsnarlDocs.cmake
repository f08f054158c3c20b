# The site: cmake --build BUILD --target docs. Needs Debian's mkdocs and no network; shows the options of the program.
find_program(MKDOCS mkdocs)
if(MKDOCS AND TARGET unsnarl_program)
  add_custom_target(docs
    COMMAND ${CMAKE_COMMAND} -E env UNSNARL_PROGRAM=$<TARGET_FILE:unsnarl_program>
      ${MKDOCS} build --strict --site-dir ${PROJECT_BINARY_DIR}/site
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    DEPENDS unsnarl_program
    VERBATIM)
endif()
