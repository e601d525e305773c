# cmake -DTOOL= -DREPLAYS= -P portable.cmake: every scene of the goldens, in its scalar, is saved, loaded, written and
# rebuilt early, halfway and late, and goes on as it would have.
file(STRINGS ${REPLAYS}/goldens.txt goldens)
list(LENGTH goldens count)
if(count LESS 100)
  message(FATAL_ERROR "${count} goldens")
endif()
foreach(golden ${goldens})
  string(REGEX MATCH "^([^ ]+) ([^ ]+) ([0-9]+) " parts ${golden})
  set(plan --frames 45 --every 20 --rollback 10)
  if(CMAKE_MATCH_3 LESS 45)  # scenes of thousands of bodies
    set(plan --frames 10 --every 4 --rollback 2)
  endif()
  execute_process(COMMAND ${TOOL} selftest ${CMAKE_MATCH_1} --scalar ${CMAKE_MATCH_2} ${plan}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0 OR NOT output MATCHES "3 times saved")
    message(FATAL_ERROR "${golden}: selftest ends with ${result}\n${output}")
  endif()
endforeach()
message("${count} scenes go on as they would have")
