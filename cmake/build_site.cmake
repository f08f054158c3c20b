# cmake -DPROGRAM=... -DSITE=FOLDER -P this, in the folder of the project: builds the site of docs/ with mkdocs.
find_program(MKDOCS mkdocs)
if(NOT MKDOCS)
  message(FATAL_ERROR "The site needs mkdocs. On Debian:\n  apt-get install --no-install-recommends mkdocs python3-pygments")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E env UNSNARL_PROGRAM=${PROGRAM} ${MKDOCS} build --strict --site-dir ${SITE}
  COMMAND_ERROR_IS_FATAL ANY)
