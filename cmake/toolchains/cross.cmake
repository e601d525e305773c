# Debian's cross compilers and what runs their programs, all in one table: -DISOSTEP_TARGET=s390x, any first word of it.
# Another compiler for the same target: -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_EXE_LINKER_FLAGS="-static -fuse-ld=lld".
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ISOSTEP_TARGET)

# name | system | processor | triplet | flags | runner. wasm's runner is the caller's.
set(isostep_targets
  "i686|Linux|i686|i686-linux-gnu|-msse2 -mfpmath=sse|qemu-i386"
  "aarch64|Linux|aarch64|aarch64-linux-gnu||qemu-aarch64"
  "aarch64-v8.3|Linux|aarch64|aarch64-linux-gnu|-march=armv8.3-a|qemu-aarch64"
  "armhf|Linux|arm|arm-linux-gnueabihf||qemu-arm"
  "riscv64|Linux|riscv64|riscv64-linux-gnu||qemu-riscv64"
  "s390x|Linux|s390x|s390x-linux-gnu||qemu-s390x"
  "ppc64|Linux|ppc64|powerpc64-linux-gnu||qemu-ppc64"
  "ppc64le|Linux|ppc64le|powerpc64le-linux-gnu||qemu-ppc64le"
  "windows|Windows|AMD64|x86_64-w64-mingw32||wine64"
  "wasm|Generic|wasm32|wasm32-wasi|-fno-exceptions|"
  "wasm-simd|Generic|wasm32|wasm32-wasi|-fno-exceptions -msimd128|")

set(isostep_row "")
foreach(row IN LISTS isostep_targets)
  if(row MATCHES "^${ISOSTEP_TARGET}[|]")
    set(isostep_row "${row}")
  endif()
endforeach()
if(NOT isostep_row MATCHES "^([^|]+)[|]([^|]+)[|]([^|]+)[|]([^|]+)[|]([^|]*)[|]([^|]*)$")
  message(FATAL_ERROR "ISOSTEP_TARGET is '${ISOSTEP_TARGET}': no row of cross.cmake begins so")
endif()
set(CMAKE_SYSTEM_NAME ${CMAKE_MATCH_2})
set(CMAKE_SYSTEM_PROCESSOR ${CMAKE_MATCH_3})
set(isostep_triplet ${CMAKE_MATCH_4})
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_MATCH_5}")
set(isostep_runner "${CMAKE_MATCH_6}")

if(CMAKE_SYSTEM_NAME STREQUAL "Generic")  # wasi-libc: neither threads nor exceptions, and no program without a runner
  set(isostep_compiler clang++)
  if(CMAKE_CXX_FLAGS_INIT MATCHES "simd128")  # clang 14's back end reorders memory there: scalar/platform.hpp
    find_program(ISOSTEP_WASM_CLANG NAMES clang++-16 clang++-17 clang++-18 clang++-19 clang++-20 clang++)
    set(isostep_compiler ${ISOSTEP_WASM_CLANG})
  endif()
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
elseif(CMAKE_SYSTEM_NAME STREQUAL "Windows")  # the win32 thread model lacks std::mutex
  set(isostep_compiler ${isostep_triplet}-g++-posix)
  set(CMAKE_RC_COMPILER ${isostep_triplet}-windres)
else()
  set(isostep_compiler ${isostep_triplet}-g++)
endif()
if(NOT CMAKE_CXX_COMPILER)
  set(CMAKE_CXX_COMPILER ${isostep_compiler})
endif()
set(CMAKE_CXX_COMPILER_TARGET ${isostep_triplet})  # what tells clang; g++ needs no telling
if(NOT CMAKE_SYSTEM_NAME STREQUAL "Generic")
  set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")  # no search for the target's libraries; empty it where there are no static
endif()

if(isostep_runner MATCHES "qemu")
  find_program(ISOSTEP_RUNNER NAMES ${isostep_runner}-static ${isostep_runner} NO_CMAKE_FIND_ROOT_PATH)
  set(isostep_emulator "${ISOSTEP_RUNNER};-L;/usr/${isostep_triplet}")
elseif(isostep_runner)
  find_program(ISOSTEP_RUNNER NAMES ${isostep_runner} PATHS /usr/lib/wine NO_CMAKE_FIND_ROOT_PATH)
  set(isostep_emulator
    "${CMAKE_COMMAND};-E;env;WINEDEBUG=-all;WINEPREFIX=${CMAKE_BINARY_DIR}/wine;${ISOSTEP_RUNNER}")
endif()
if(isostep_runner AND ISOSTEP_RUNNER)
  set(CMAKE_CROSSCOMPILING_EMULATOR "${isostep_emulator}")
endif()
mark_as_advanced(ISOSTEP_RUNNER)
