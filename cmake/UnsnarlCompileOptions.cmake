# One interface target with the compile options every target of the project shares.
set(UNSNARL_GENERATED_INCLUDE_DIR ${PROJECT_BINARY_DIR}/include)
configure_file(${CMAKE_CURRENT_LIST_DIR}/version.h.in ${UNSNARL_GENERATED_INCLUDE_DIR}/unsnarl/version.h @ONLY)

string(TOUPPER "CMAKE_CXX_FLAGS_${CMAKE_BUILD_TYPE}" flags_of_the_type)
set(flags_of_the_user "${CMAKE_CXX_FLAGS} ${${flags_of_the_type}}")
# Signs would be wrong, and results certified that intersect. geometry/predicates.h refuses those that a macro tells.
set(unsafe_flags
  -ffast-math -Ofast -funsafe-math-optimizations -fassociative-math -freciprocal-math -ffinite-math-only -mfpmath=387
  -fsingle-precision-constant)
foreach(flag IN LISTS unsafe_flags)
  if(" ${flags_of_the_user} " MATCHES " ${flag} ")
    message(FATAL_ERROR "unsnarl would certify falsely when compiled with ${flag}: configure without it.")
  endif()
endforeach()

# Shared libraries are made of the same objects; WebAssembly has none.
set(UNSNARL_SHAREABLE ON)
if(EMSCRIPTEN)
  set(UNSNARL_SHAREABLE OFF)
endif()

add_library(unsnarl_compile_options INTERFACE)
target_compile_features(unsnarl_compile_options INTERFACE cxx_std_20)
target_compile_options(unsnarl_compile_options INTERFACE
  -Wall -Wextra -Wpedantic
  # The same bytes on every machine of one build: no contraction of a*b+c into one rounding.
  -ffp-contract=off
  $<$<BOOL:${UNSNARL_WARNINGS_AS_ERRORS}>:-Werror>)
# The same bytes on every machine of every build: sums of Eigen in an order that no register's size decides. [E252]
target_compile_definitions(unsnarl_compile_options INTERFACE EIGEN_DONT_VECTORIZE)
target_include_directories(unsnarl_compile_options INTERFACE
  ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src ${UNSNARL_GENERATED_INCLUDE_DIR})

# The same bytes from every folder.
target_compile_options(unsnarl_compile_options INTERFACE
  -ffile-prefix-map=${PROJECT_BINARY_DIR}=build -ffile-prefix-map=${PROJECT_SOURCE_DIR}=.)

if(WIN32)
  add_compile_definitions(_WIN32_WINNT=0x0A00)  # Windows 10 and later
  add_compile_definitions(__USE_MINGW_ANSI_STDIO=1)  # printf() and the like as in C99
endif()

# A mistake in memory ends the program rather than being of use to a hostile file; tests/packaging/hardening_test.py
# reads it off what is built. Sanitizers do this and more, in ways of their own.
if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND NOT flags_of_the_user MATCHES "-fsanitize" AND NOT UNSNARL_BUILD_FUZZERS)
  include(CheckPIESupported)
  check_pie_supported()
  set(is_optimised $<NOT:$<CONFIG:Debug>>)  # without, there is nothing that _FORTIFY_SOURCE could check
  target_compile_options(unsnarl_compile_options INTERFACE
    -fstack-protector-strong -fstack-clash-protection
    $<$<STREQUAL:${CMAKE_SYSTEM_PROCESSOR},x86_64>:-fcf-protection>
    $<${is_optimised}:-U_FORTIFY_SOURCE> $<${is_optimised}:-D_FORTIFY_SOURCE=2>)
  # For what reads files and takes arguments. In the solvers, which see surfaces that were checked, it costs more than 1 %.
  set(UNSNARL_CHECKED -D_GLIBCXX_ASSERTIONS)
  add_link_options(LINKER:-z,relro LINKER:-z,now LINKER:-z,noexecstack)
  string(COMPARE NOTEQUAL "${CMAKE_BUILD_TYPE}" Debug UNSNARL_HARDENED)
endif()
