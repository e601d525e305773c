# cmake -DMODE=installed|subfolder -DBUILD=the library's build folder -DSOURCE= -DWORK= -DTOOL= -P package.cmake
# Configures, builds and runs the game; the stock tool must verify what it recorded.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "${command} ends with ${result}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(options -G "${GENERATOR}" -DCMAKE_CXX_COMPILER=${COMPILER})
if(LAUNCHER)
  list(APPEND options -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
endif()
file(REMOVE_RECURSE ${WORK})
if(MODE STREQUAL "installed")
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
  list(APPEND options -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_FLAGS=${FLAGS})
else()
  # At -O0, with one scalar and one lane, many files at a time: quick, a test of these options, and the hashes must be
  # those of the optimised library.
  list(APPEND options -DISOSTEP_SOURCE=${SOURCE} -DISOSTEP_SCALARS=Q32_32 -DISOSTEP_SIMD=OFF -DISOSTEP_TRANSPORT=ON
    -DISOSTEP_THREADS=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_CXX_FLAGS=-O0)
endif()
if("$ENV{ISOSTEP_WHOLE}" STREQUAL "1")
  list(APPEND options -DOWN_SCALAR=ON)  # which instantiates the engine once more
endif()
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/package/game -B ${WORK}/build ${options})
run(${CMAKE_COMMAND} --build ${WORK}/build --parallel 2)

run(${WORK}/build/own_physics)
run(${WORK}/build/own_match)
run(${WORK}/build/own_line)
run(${WORK}/build/own_workers)
if(EXISTS ${WORK}/build/own_seal)
  run(${WORK}/build/own_seal)
endif()
if(MODE STREQUAL "installed" AND "$ENV{ISOSTEP_WHOLE}" STREQUAL "1")
  run(${WORK}/build/own_scalar)
  message("${output}")
endif()

# The C interface by CMake; by pkg-config it is tried by hellos_test.sh.
if(MODE STREQUAL "installed" AND EXISTS ${WORK}/prefix/include/isostep.h)
  run(${CMAKE_COMMAND} -S ${SOURCE}/tests/package/game_c -B ${WORK}/build_c -G "${GENERATOR}"
    -DCMAKE_PREFIX_PATH=${WORK}/prefix -DHELLO=${SOURCE}/src/examples/hello.c)
  run(${CMAKE_COMMAND} --build ${WORK}/build_c)
  run(${WORK}/build_c/game_c)
  if(EXISTS ${WORK}/build_c/udp)
    run(${WORK}/build_c/udp)
  endif()
endif()

run(${WORK}/build/game ${WORK}/game.replay)
message("last hash ${output}")
if(TOOL)
  run(${TOOL} verify ${WORK}/game.replay)
  if(NOT output MATCHES "VERIFIED")
    message(FATAL_ERROR "the tool does not verify the game's replay:\n${output}")
  endif()
  message("${output}")
endif()
