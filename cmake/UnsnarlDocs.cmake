# The site: cmake --build BUILD --target docs. Needs Debian's mkdocs and no network; shows the options of the program.
if(TARGET unsnarl_program)
  add_custom_target(docs
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:unsnarl_program> -DSITE=${PROJECT_BINARY_DIR}/site
      -P ${PROJECT_SOURCE_DIR}/cmake/build_site.cmake
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    DEPENDS unsnarl_program
    VERBATIM)
endif()
