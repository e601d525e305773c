# cmake -DCOMPILER= -DINCLUDES= -DSOURCE= "-DFLAGS=..." -P refused.cmake: the flags are refused, with our message; without
# them the same file compiles.
function(compile)
  set(include_flags ${INCLUDES})
  list(TRANSFORM include_flags PREPEND -I)
  execute_process(COMMAND ${COMPILER} -std=c++20 -fsyntax-only -Wfatal-errors ${include_flags} ${ARGN} ${SOURCE}
    RESULT_VARIABLE result ERROR_VARIABLE errors OUTPUT_QUIET)
  set(result ${result} PARENT_SCOPE)
  set(errors "${errors}" PARENT_SCOPE)
endfunction()

compile(${FLAGS})
if(result EQUAL 0)
  message(FATAL_ERROR "${COMPILER} ${FLAGS}: accepted")
elseif(NOT errors MATCHES "isostep: ")
  message(FATAL_ERROR "${COMPILER} ${FLAGS}: fails, and not for our reason\n${errors}")
endif()
compile()
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${COMPILER} fails without the flags too\n${errors}")
endif()
