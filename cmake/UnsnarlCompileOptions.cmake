# One interface target with the compile options every target of the project shares.
set(UNSNARL_GENERATED_INCLUDE_DIR ${PROJECT_BINARY_DIR}/include)
configure_file(${CMAKE_CURRENT_LIST_DIR}/version.h.in ${UNSNARL_GENERATED_INCLUDE_DIR}/unsnarl/version.h @ONLY)

add_library(unsnarl_compile_options INTERFACE)
target_compile_features(unsnarl_compile_options INTERFACE cxx_std_20)
target_compile_options(unsnarl_compile_options INTERFACE
  -Wall -Wextra -Wpedantic
  # The same bytes on every machine of one build: no contraction of a*b+c into one rounding.
  -ffp-contract=off
  $<$<BOOL:${UNSNARL_WARNINGS_AS_ERRORS}>:-Werror>)
target_include_directories(unsnarl_compile_options INTERFACE
  ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src ${UNSNARL_GENERATED_INCLUDE_DIR})
