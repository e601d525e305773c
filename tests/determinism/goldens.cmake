# cmake -DTOOL= -DREPLAYS= -P goldens.cmake: the tool verifies every golden list and replay of the repository.
file(GLOB goldens ${REPLAYS}/goldens/*.txt)
file(GLOB_RECURSE recordings ${REPLAYS}/*.replay)
if(NOT goldens AND NOT recordings)
  message("no goldens yet")
  return()
endif()
execute_process(COMMAND ${TOOL} verify --jobs 2 ${REPLAYS} RESULT_VARIABLE result OUTPUT_VARIABLE output
  ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "verify ends with ${result}: a change of results needs `isostep rebake` and a RESULT line in "
    "CHANGELOG.md\n${output}")
endif()
string(REGEX MATCHALL "VERIFIED" verified "${output}")
list(LENGTH goldens expected)
list(LENGTH verified count)
if(count LESS expected)
  message(FATAL_ERROR "${count} verified of ${expected} golden lists\n${output}")
endif()
