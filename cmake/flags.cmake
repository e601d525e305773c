# The flags behind "same inputs, same bits": what they are for is in tests/matrix/README.md.
include(GNUInstallDirs)

# Contraction fuses a * b + c where the target can; gcc's vectorisers fuse in spite of that flag. Without errno a square
# root is the instruction and never a call of the C library. Private: a user's own code is compiled as the user likes,
# and nothing of ours is inlined into it but integer code and exact leaves.
set(isostep_exact_flags
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-fno-fast-math;-ffp-contract=off;-fno-math-errno>
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-vectorize;-fno-tree-slp-vectorize>
  $<$<CXX_COMPILER_ID:MSVC>:/fp:precise>)
set(isostep_warnings
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wpedantic;-Wshadow>
  $<$<CXX_COMPILER_ID:MSVC>:/W4;/permissive->)
# The libraries' code also says every conversion that may lose something, which clang extends to signs.
set(isostep_library_warnings ${isostep_warnings} $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wconversion>)

# g++ collects its garbage from 128 MB on; from 512 MB on it compiles our templates 7 % sooner, in a fifth more memory.
set(isostep_roomy_flags $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)
# Where the library does the work, code is compiled more often than it is run.
set(isostep_quick_flags $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-O1>)

isostep_speed_flags(isostep_speed)
if(ISOSTEP_QUICK_BUILD)
  set(CMAKE_UNITY_BUILD ON)
  set(isostep_speed $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang,AppleClang>>:-O2>)
elseif(isostep_speed)
  message(STATUS "isostep: no CMAKE_BUILD_TYPE: the engine is compiled with -O2, the rest of the project is not")
endif()

# For games that keep float arithmetic of their own in step: link it, and their code gets the same flags.
add_library(isostep_deterministic_flags INTERFACE)
add_library(isostep::deterministic_flags ALIAS isostep_deterministic_flags)
target_compile_options(isostep_deterministic_flags INTERFACE ${isostep_exact_flags})

# Where the headers of isostep::transport and isostep::threads are installed, below the prefix.
set(isostep_extras ${CMAKE_INSTALL_INCLUDEDIR}/isostep_extras)

# Sets a library of ours up: public headers under `include_dir`, private exact flags.
function(isostep_library target export_name include_dir)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/${include_dir}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_options(${target} PRIVATE ${isostep_exact_flags} ${isostep_speed} ${isostep_library_warnings}
    ${isostep_roomy_flags})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${export_name})
  if(NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "wasm32")  # there it goes into no shared library, and costs size and time
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  if(ISOSTEP_NO_INT128)
    target_compile_definitions(${target} PUBLIC ISOSTEP_NO_INT128)
  endif()
  if(NOT ISOSTEP_SIMD)
    target_compile_definitions(${target} PUBLIC ISOSTEP_NO_SIMD)
  endif()
  if(NOT ISOSTEP_BOOK)
    target_compile_definitions(${target} PUBLIC ISOSTEP_NO_BOOK)
  endif()
  foreach(scalar float double Q16_16 Q32_32)
    if(NOT scalar IN_LIST ISOSTEP_SCALARS)
      string(TOUPPER ${scalar} upper)
      target_compile_definitions(${target} PUBLIC ISOSTEP_NO_${upper})
    endif()
  endforeach()
endfunction()

set(isostep_avx512 -mavx512f -mavx512dq -mavx512vl)

# A kernel of one instruction set: its own file, its own flags, where the compiler targets x86-64. gcc gathers sums of
# integers at their end, with every term waiting in memory till then; without these two passes it adds as it goes.
function(isostep_kernel_flags file)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64" AND CMAKE_SIZEOF_VOID_P EQUAL 8)
    # Under sanitizers these templates take minutes and gigabytes; the kernels of one lane are the same code.
    set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS
      "${ARGN};-fno-sanitize=all;$<$<CXX_COMPILER_ID:GNU>:-fno-tree-ter>;$<$<CXX_COMPILER_ID:GNU>:-fno-tree-reassoc>")
  endif()
endfunction()
