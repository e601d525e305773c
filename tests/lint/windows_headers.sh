#!/bin/sh
# Every public header, read as Microsoft's compilers read it, and the engine for a scalar of 40 fractional bits. What
# stands in for them is clang behind cl's command line, by Microsoft's ABI and language rules (long has 32 bits), with
# the headers of mingw's C and C++ libraries; their own are not to be had. Thrice: as clang, as clang-cl, and as MSVC,
# that is without what clang defines. A compiler's own parser and warnings remain unproved.
# usage: windows_headers.sh SOURCE_DIRECTORY SCRATCH_DIRECTORY; exits 77 where clang++ or mingw are missing.
# SPDX-License-Identifier: MIT
set -u
source=$1
scratch=$2
mkdir -p "$scratch" && cd "$scratch" || exit 1

clang=$(command -v clang++-19 || command -v clang++-16 || command -v clang++) || exit 77
mingw=$(command -v x86_64-w64-mingw32-g++-posix || command -v x86_64-w64-mingw32-g++) || exit 77
headers=$(echo | "$mingw" -xc++ -E -v - 2>&1 | sed -n '/^#include </,/^End/s/^ //p')
resources=$("$clang" -print-resource-dir)/include
set -- "$clang" --driver-mode=cl --target=x86_64-pc-windows-msvc -fmsc-version=0 -Xclang -fgnuc-version=12.2.0 /Zs \
  -D__MINGW32__ -D__MINGW64__ -D__STRICT_ANSI__ -D_UCRT -D__INTRIN_H \
  /std:c++20 /W4 /WX /permissive- /fp:precise /EHsc -I"$source/include" -I"$source/scalar/include" -imsvc "$resources"
for directory in $headers; do
  directory=$(cd "$directory" && pwd -P) || exit 1
  # gcc's own intrinsics and limits would not do for clang
  case $directory in */lib/gcc/*/include | */lib/gcc/*/include-fixed) ;; *) set -- "$@" -imsvc "$directory" ;; esac
done

failed=0
check() {
  name=$1
  shift
  if ! "$@" "$name.cpp" >"$name.log" 2>&1; then
    failed=1
    echo "$name: $*" >&2
    head -n 40 "$name.log" >&2
  fi
}

# Ours, but what only another machine's intrinsics can compile and what wants Eigen.
ours() {
  for root in include scalar/include; do
    (cd "$source/$root" && find . -name '*.hpp') | sed 's|^\./||' | grep -v -e lanes_ -e eigen | sort |
      sed 's/.*/#include "&"/'
  done
}
# The standard's, first: they are mingw's, and want to be read by what they take for gcc.
standard() {
  grep -rhoE '^#include <[a-z_]+>' "$source/include" "$source/scalar/include" | sort -u
  echo '#include <immintrin.h>'
}
undefine() { for name in "$@"; do echo "#undef $name"; done; }

ours >clang.cpp
{ standard; undefine __GNUC__ __GNUC_MINOR__ _MSC_VER; echo '#define _MSC_VER 1940'; ours; } >clang_cl.cpp
{ standard
  undefine __GNUC__ __GNUC_MINOR__ __clang__ _MSC_VER __x86_64__ __SSE2__ __SSE4_1__ __AVX__ __SIZEOF_INT128__
  printf '#define _MSC_VER 1940\n#define _M_X64 100\n'; ours; } >msvc.cpp
# A game has included <windows.h>, whose macros are many.
{ echo '#define NOMINMAX'; echo '#include <windows.h>'; ours; } >after_windows.cpp
# As isostep_add_scalar() compiles it.
{ echo '#define ISOSTEP_OWN_SCALARS'
  echo '#include "isostep/instantiate/engine.inl"'
  echo 'ISO_INSTANTIATE_ENGINE(isostep::Fixed<std::int64_t, 40>)'; } >engine.cpp
echo 'static_assert(sizeof(long) == 8);' >control.cpp

for name in clang clang_cl msvc; do check "$name" "$@"; done
if [ "${ISOSTEP_WHOLE:-}" = 1 ]; then check engine "$@"; fi  # as much as a part of the library
# The check can fail, and the rules are Microsoft's.
if "$@" control.cpp >control.log 2>&1 || ! grep -q 'static assertion failed' control.log; then
  echo "control: long should not have 64 bits here" >&2
  failed=1
fi
exit "$failed"
