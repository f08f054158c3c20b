# A toolchain file of CMake: Debian's emscripten makes WebAssembly, with what link_headers or static_dependencies has put
# into UNSNARL_TARGET_PREFIX; Node.js runs it.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES UNSNARL_TARGET_PREFIX)
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
list(APPEND CMAKE_FIND_ROOT_PATH ${UNSNARL_TARGET_PREFIX})
set(CMAKE_C_FLAGS_INIT "-fwasm-exceptions -sSUPPORT_LONGJMP=wasm")
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -sSUPPORT_LONGJMP=wasm")
set(CMAKE_EXE_LINKER_FLAGS_INIT
  "-sALLOW_MEMORY_GROWTH=1 -sENVIRONMENT=node -sEXIT_RUNTIME=1 -sNODERAWFS=1 -fwasm-exceptions -sSUPPORT_LONGJMP=wasm")
