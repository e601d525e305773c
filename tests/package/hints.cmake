# cmake -DSOURCE= -DWORK= -DCOMPILER= -DGENERATOR= -P hints.cmake
# What a project gets that does not build as it should: one line that says what to do, or a fast engine all the same.
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
set(includes -I${SOURCE}/include -I${SOURCE}/scalar/include)

# expect_one_error(text flags...): WORK/user.cpp is refused in one error, which has the text.
function(expect_one_error text)
  execute_process(COMMAND ${COMPILER} ${ARGN} -fsyntax-only ${includes} user.cpp WORKING_DIRECTORY ${WORK}
    RESULT_VARIABLE result ERROR_VARIABLE said OUTPUT_QUIET)
  string(REGEX MATCHALL "error: [^\n]*" errors "${said}")
  list(LENGTH errors count)
  if(result EQUAL 0 OR NOT count EQUAL 1 OR NOT errors MATCHES "${text}")
    file(READ ${WORK}/user.cpp user)
    message(FATAL_ERROR "${ARGN}: ${count} errors, expected one with \"${text}\":\n${user}${said}")
  endif()
endfunction()

# An older standard, whichever header comes first; in a sample, every fourth.
file(GLOB_RECURSE headers RELATIVE ${SOURCE}/include ${SOURCE}/include/*.hpp)
file(GLOB_RECURSE scalar_headers RELATIVE ${SOURCE}/scalar/include ${SOURCE}/scalar/include/*.hpp)
set(turn 0)
foreach(header ${headers} ${scalar_headers})
  math(EXPR turn "(${turn} + 1) % 4")
  if(NOT turn EQUAL 0 AND NOT "$ENV{ISOSTEP_WHOLE}" STREQUAL "1")
    continue()
  endif()
  if(header MATCHES "eigen|lanes_(sse2|avx|neon|wasm)")  # which begin with a library's or a processor's own
    continue()
  endif()
  file(WRITE ${WORK}/user.cpp "#include <${header}>\n")
  expect_one_error("isostep needs C[+][+]20: compile with -std=c[+][+]20" -std=c++17)
endforeach()

# A scalar that nobody instantiated, and a shipped one that this library lacks.
file(WRITE ${WORK}/user.cpp "#include <isostep/isostep.hpp>\nisostep::World<isostep::Fixed<std::int64_t, 40>> world;\n")
expect_one_error("isostep_add_scalar" -std=c++20)
file(WRITE ${WORK}/user.cpp "#include <isostep/isostep.hpp>\nisostep::ParticleWorld<float> world;\n")
expect_one_error("ISOSTEP_SCALARS" -std=c++20 -DISOSTEP_NO_FLOAT)

# expect_speed(yes|no flags...): whether the engine in a project with these flags is optimised, and the game is not.
function(expect_speed expected)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/tests/package/game -B ${WORK}/build -G ${GENERATOR}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DISOSTEP_SOURCE=${SOURCE} -DISOSTEP_TRANSPORT=ON -DISOSTEP_THREADS=ON
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${said}")
  endif()
  file(READ ${WORK}/build/compile_commands.json commands)
  string(JSON last LENGTH "${commands}")
  math(EXPR last "${last} - 1")
  foreach(i RANGE ${last})
    string(JSON file GET "${commands}" ${i} file)
    string(JSON command GET "${commands}" ${i} command)
    string(FIND "${command}" " -O2 " optimised)
    if(file MATCHES "/src/(isostep/instantiate|transport|threads)/" AND optimised EQUAL -1)
      set(found no)
    elseif(file MATCHES "/game/main.cpp$" AND NOT optimised EQUAL -1)
      message(FATAL_ERROR "${ARGN}: the game's own files are compiled with -O2")
    endif()
  endforeach()
  if(NOT DEFINED found)
    set(found yes)
  endif()
  if(NOT found STREQUAL expected)
    message(FATAL_ERROR "${ARGN}: optimised: ${found}, expected ${expected}")
  endif()
  if(expected STREQUAL "yes" AND NOT said MATCHES "isostep: no CMAKE_BUILD_TYPE")
    message(FATAL_ERROR "nobody is told that there is no build type:\n${said}")
  endif()
endfunction()
if(NOT GENERATOR MATCHES "Ninja|Makefiles" OR GENERATOR MATCHES "Multi")
  return()
endif()
expect_speed(yes)
expect_speed(no -DCMAKE_BUILD_TYPE=Debug)
expect_speed(no -DCMAKE_BUILD_TYPE= -DCMAKE_CXX_FLAGS=-O0)
