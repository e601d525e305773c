# cmake -DSOURCE= -DWORK= -DCOMPILER= -DGENERATOR= -DREPLAYS= -P other_compiler.cmake: the tool, built by another
# compiler at another level of optimisation, verifies every golden. File by file, so that each has to include
# what it uses.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN} ends with ${result}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release
  "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG" -DISOSTEP_TESTS=OFF -DISOSTEP_EXAMPLES=OFF -DISOSTEP_FETCH_THREE=OFF
  -DCMAKE_UNITY_BUILD=OFF)
run(${CMAKE_COMMAND} --build ${WORK} --target isostep_tool --parallel 2)
run(${WORK}/src/tool/isostep verify --jobs 2 ${REPLAYS})
string(REGEX MATCHALL "VERIFIED" verified "${output}")
list(LENGTH verified count)
file(STRINGS ${REPLAYS}/goldens.txt goldens)
list(LENGTH goldens expected)
if(count LESS expected OR expected EQUAL 0)
  message(FATAL_ERROR "${count} verified of ${expected} goldens\n${output}")
endif()
message("${count} goldens verified by ${COMPILER}")
