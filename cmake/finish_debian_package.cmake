# Run by cpack on what it is about to pack: the files that Debian's policy asks for beside those that are installed.
set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/unsnarl${CPACK_PACKAGING_INSTALL_PREFIX})
set(usr_dev ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/unsnarl_dev${CPACK_PACKAGING_INSTALL_PREFIX})
file(MAKE_DIRECTORY ${usr_dev}/share/doc/libunsnarl-dev)
file(COPY_FILE ${usr}/share/doc/unsnarl/NOTICE ${usr_dev}/share/doc/libunsnarl-dev/copyright)
file(RENAME ${usr}/share/doc/unsnarl/NOTICE ${usr}/share/doc/unsnarl/copyright)
file(RENAME ${usr}/share/doc/unsnarl/CHANGELOG.md ${usr}/share/doc/unsnarl/changelog)
file(COPY_FILE ${usr}/share/doc/unsnarl/changelog ${usr_dev}/share/doc/libunsnarl-dev/changelog)
execute_process(
  COMMAND gzip -9n ${usr}/share/doc/unsnarl/changelog ${usr_dev}/share/doc/libunsnarl-dev/changelog
    ${usr}/share/man/man1/unsnarl.1
  COMMAND_ERROR_IS_FATAL ANY)
