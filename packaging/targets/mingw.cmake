# A toolchain file of CMake: Debian's mingw-w64 with threads of POSIX makes programs of Windows, with what
# static_dependencies has put into UNSNARL_TARGET_PREFIX; wine runs them.
#
#   cmake -DCMAKE_TOOLCHAIN_FILE=packaging/targets/mingw.cmake -DUNSNARL_TARGET_PREFIX=FOLDER ...
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES UNSNARL_TARGET_PREFIX)
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
find_program(WINE NAMES wine wine64 PATHS /usr/lib/wine)
if(WINE)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${WINE})
endif()

# Nothing of the system that compiles is taken but its programs.
set(CMAKE_FIND_ROOT_PATH ${UNSNARL_TARGET_PREFIX} /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

# A program is one file: with the compiler's own libraries inside too.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_SHARED_LINKER_FLAGS_INIT -static)
set(CMAKE_MODULE_LINKER_FLAGS_INIT -static)
set(ZLIB_USE_STATIC_LIBS ON)
