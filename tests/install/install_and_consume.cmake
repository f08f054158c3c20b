# Installs the built project under a fresh prefix, then configures, builds and runs a consumer that knows only the prefix.
# cmake -DBUILD_DIR=... -DCONSUMER_DIR=... -DWORK_DIR=... -DCXX_COMPILER=... -DCXX_FLAGS=... -DBUILD_TYPE=...
#       -DGENERATOR=... -DMAN_PAGE=PATH_BELOW_PREFIX_OR_NOTHING -P this
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "failed (${result}): ${command}")
  endif()
endfunction()

cmake_path(IS_PREFIX BUILD_DIR ${WORK_DIR} NORMALIZE is_of_the_build)
if(NOT is_of_the_build)
  message(FATAL_ERROR "WORK_DIR is emptied and so has to be a folder below BUILD_DIR")
endif()
file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix --component unsnarl)
run(${CMAKE_COMMAND} -S ${CONSUMER_DIR} -B ${WORK_DIR}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_CXX_FLAGS=${CXX_FLAGS} -DCMAKE_C_FLAGS=${CXX_FLAGS} -DCMAKE_BUILD_TYPE=${BUILD_TYPE})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/consumer)
run(${WORK_DIR}/build/consumer_in_c)
if(MAN_PAGE AND NOT EXISTS ${WORK_DIR}/prefix/${MAN_PAGE})
  message(FATAL_ERROR "the man page was not installed to ${MAN_PAGE}")
endif()
