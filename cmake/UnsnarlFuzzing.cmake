# Coverage for libFuzzer and sanitizers in everything that is built; tests/fuzz adds the fuzzers.
if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  message(FATAL_ERROR "UNSNARL_BUILD_FUZZERS needs clang: configure with --preset fuzz")
endif()
add_compile_options(-fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow -fno-sanitize-recover=all
  -fno-omit-frame-pointer -O1 -gline-tables-only)
add_link_options(-fsanitize=address,undefined)
