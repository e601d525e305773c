#!/bin/sh
# The first programs of the pages of C and Python, taken from the pages, and hello.cpp by pkg-config, against an
# installed isostep: all print the last hash of hello.cpp, and so do the pages.
# usage: hellos_test.sh REPOSITORY PREFIX EXAMPLE_HELLO
# SPDX-License-Identifier: MIT
set -u
. "$1/tests/scratch.sh"
repository=$1 prefix=$2
hash=$("$3" | cut -d ' ' -f 1)
[ ${#hash} -eq 16 ] || fail "hello.cpp prints no hash"

# first_block PAGE LANGUAGE: of its blocks in that language.
first_block() {
  awk -v mark="\`\`\`$2" '/^```$/ && inside {exit} inside; $0 == mark {inside = 1}' "$repository/$1"
}
# prints_hash WHAT COMMAND...
prints_hash() {
  what=$1
  shift
  "$@" >"$dir/out" 2>"$dir/err" || fail "the $what of the page exits $?"
  [ "$(cut -d ' ' -f 1 "$dir/out")" = "$hash" ] || fail "the $what of the page prints another hash than $hash"
}
for page in src/c/README.md src/python/README.md src/csharp/README.md; do
  grep -q "$hash" "$repository/$page" || fail "$page does not say that $hash is printed"
done

cd "$dir" || exit 1
pc=$(find "$prefix" -name isostep.pc)
PKG_CONFIG_PATH=$(dirname "$pc")
LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH")
export PKG_CONFIG_PATH LD_LIBRARY_PATH
if command -v pkg-config >/dev/null && command -v cc >/dev/null; then
  first_block src/c/README.md c >hello.c
  grep -q 'int main' hello.c || fail "the first block of the page of C is no program"
  first_block src/c/README.md sh | grep '^cc ' >compile.sh
  sh -e compile.sh >out 2>err || fail "'$(cat compile.sh)' fails"
  prints_hash "program in C" ./hello
fi
compiler=$(command -v g++ || command -v c++)
if command -v pkg-config >/dev/null && [ -n "$compiler" ]; then
  # shellcheck disable=SC2046
  "$compiler" -std=c++20 "$repository/src/examples/hello.cpp" -o hello_cpp $(pkg-config --cflags --libs isostep-cpp) ||
    fail "hello.cpp does not compile with isostep-cpp.pc"
  prints_hash "program in C++" ./hello_cpp
  # Containers of another layout: the linker says so. The library is one without.
  # shellcheck disable=SC2046
  if "$compiler" -std=c++20 -D_GLIBCXX_DEBUG "$repository/src/examples/hello.cpp" -o hello_debug \
    $(pkg-config --cflags --libs isostep-cpp) 2>err; then
    fail "a program with -D_GLIBCXX_DEBUG links against a library without"
  fi
  grep -q 'isostep_must_be_compiled_with_GLIBCXX_DEBUG_as_well' err || fail "the linker does not say what differs"
fi
python=/usr/bin/python3
if [ -x "$python" ]; then
  first_block src/python/README.md python >hello.py
  unset ISOSTEP_LIBRARY LD_LIBRARY_PATH  # it finds the library by itself
  PYTHONPATH=$prefix/share/isostep/python
  PYTHONDONTWRITEBYTECODE=1
  export PYTHONPATH PYTHONDONTWRITEBYTECODE
  prints_hash "program in Python" "$python" hello.py
fi
exit 0
