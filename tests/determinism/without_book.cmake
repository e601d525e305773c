# cmake -DSOURCE= -DWORK= [-DCOMPILER=] [-DGENERATOR=] -P without_book.cmake: the tool, built without the book's methods
# (ISOSTEP_BOOK), verifies what needs none of them, and refuses by name what does, and so does the library. Two scalars
# of one lane.
set(why "this build leaves out")
set(REPLAYS ${SOURCE}/replays)
# Ends with `status` and says `text`.
function(expect status text)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(FIND "${output}" "${text}" found)
  if(NOT result EQUAL status OR found EQUAL -1)
    message(FATAL_ERROR "${ARGN} ends with ${result}, not with ${status} and \"${text}\"\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(build "")
if(GENERATOR)
  list(APPEND build -G ${GENERATOR})
endif()
if(COMPILER)
  list(APPEND build -DCMAKE_CXX_COMPILER=${COMPILER})
endif()
expect(0 "" ${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK} ${build}
  -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG" "-DISOSTEP_SCALARS=double\\;Q32_32" -DISOSTEP_BOOK=OFF
  -DISOSTEP_SIMD=OFF -DISOSTEP_TESTS=ON -DISOSTEP_EXAMPLES=OFF -DISOSTEP_PROVER=OFF -DISOSTEP_C=OFF
  -DISOSTEP_FETCH_THREE=OFF -DISOSTEP_INSTALL=ON)
expect(0 "" ${CMAKE_COMMAND} --build ${WORK} --target isostep_tool test_unit_left_out --parallel 2)
set(tool ${WORK}/src/tool/isostep)
expect(0 "PASSED" ${WORK}/tests/unit/test_unit_left_out)

expect(0 "replays skipped: ${why} worst_first: ISOSTEP_BOOK is off" ${tool} selfcheck)

# Goldens of scenes that have everything in them, and one line that needs the book.
file(STRINGS ${REPLAYS}/goldens.txt goldens REGEX "^(medley|mixed|mixed_pgs|coarse_box_tree|bridge) (double|q32.32) ")
list(LENGTH goldens count)
if(NOT count EQUAL 10)
  message(FATAL_ERROR "${count} goldens of ten")
endif()
list(JOIN goldens "\n" text)
file(WRITE ${WORK}/goldens.txt "${text}\n")
expect(0 "10 of 10 verified" ${tool} verify --jobs 2 ${WORK}/goldens.txt)
foreach(pair "mixed_worst_first=worst_first" "coarse_grid=grid")
  string(REGEX MATCH "^(.*)=(.*)$" parts ${pair})
  set(scene ${CMAKE_MATCH_1})
  set(method ${CMAKE_MATCH_2})
  file(STRINGS ${REPLAYS}/goldens.txt golden REGEX "^${scene} double ")
  file(WRITE ${WORK}/goldens.txt "${golden}\n")
  expect(2 "INCOMPATIBLE: ${why} ${method}: ISOSTEP_BOOK is off" ${tool} verify ${WORK}/goldens.txt)
  expect(64 "${why} ${method}: ISOSTEP_BOOK is off" ${tool} run ${scene} --scalar double --frames 1)
endforeach()

# A recording, an option, a file.
expect(2 "INCOMPATIBLE: ${why} worst_first" ${tool} verify ${REPLAYS}/selfcheck/medley_worst_first.double.replay)
expect(64 "${why} worst_first" ${tool} run S1x5 --scalar double --frames 1 --solver worst_first)
expect(64 "${why} oct_tree" ${tool} run S1x5 --scalar double --frames 1 --broad-phase oct_tree)
file(WRITE ${WORK}/scene.json "{\"solver\": \"worst_first\", \"bodies\": []}")
expect(64 "scene.json: ${why} worst_first" ${tool} run ${WORK}/scene.json --scalar double --frames 1)
file(WRITE ${WORK}/scene.json "{\"broad_phase\": \"grid\", \"bodies\": []}")
expect(64 "scene.json: ${why} grid" ${tool} run ${WORK}/scene.json --scalar double --frames 1)
expect(64 "${why} worst_first" ${tool} regenerate --recordings --dir ${WORK}/set)

# What is installed has not got the room, and says so to those who compile against it.
expect(0 "" ${CMAKE_COMMAND} --install ${WORK} --prefix ${WORK}/prefix)
if(EXISTS ${WORK}/prefix/include/isostep/book)
  message(FATAL_ERROR "the room is installed")
endif()
file(GLOB_RECURSE targets ${WORK}/prefix/isostep-targets.cmake ${WORK}/prefix/*/isostep-targets.cmake)
file(STRINGS "${targets}" defined REGEX "ISOSTEP_NO_BOOK")
if(NOT defined)
  message(FATAL_ERROR "the package does not define ISOSTEP_NO_BOOK")
endif()
message("without the book: 10 goldens verified, everything else refused by name")
