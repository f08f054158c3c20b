# Run by cpack on what it is about to pack: the files that Debian's policy asks for beside those that are installed.
set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX})
file(RENAME ${usr}/share/doc/unsnarl/NOTICE ${usr}/share/doc/unsnarl/copyright)
file(COPY_FILE ${CMAKE_CURRENT_LIST_DIR}/../CHANGELOG.md ${usr}/share/doc/unsnarl/changelog)
execute_process(
  COMMAND gzip -9n ${usr}/share/doc/unsnarl/changelog ${usr}/share/man/man1/unsnarl.1 COMMAND_ERROR_IS_FATAL ANY)
