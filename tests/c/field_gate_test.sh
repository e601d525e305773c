#!/bin/sh
# A field that C++ gets and isostep.h does not is caught: the interface no longer compiles, and says which struct it is.
# usage: field_gate_test.sh REPOSITORY CXX
# SPDX-License-Identifier: MIT
set -u
. "$1/tests/scratch.sh"
header=isostep/store/events.hpp
mkdir -p "$dir/include/isostep/store" || exit 1
compile() { "$2" -std=c++20 -fsyntax-only "-I$dir/include" "-I$1/include" "-I$1/scalar/include" "-I$1/src/c" \
  "$1/src/c/layout_checks.cpp" 2>"$dir/err"; }

# A copy of the header takes the other's place; one more member of StepReport, in the middle of its fields.
cp "$1/include/$header" "$dir/include/$header" && compile "$@" || fail "what is committed does not compile"
sed -i -e 's/^  std::uint32_t stopped = 0;.*/&\n  std::uint32_t added = 0;/' \
  -e 's/^  ISO_FIELDS(clamped_speed, .*stopped,/& added,/' "$dir/include/$header"
[ "$(grep -c added "$dir/include/$header")" -eq 2 ] || fail "StepReport has other members than this test expects"
! compile "$@" || fail "a field that the header has not compiles"
grep -q 'iso_step_report is not what the library takes it for' "$dir/err" || fail "the struct is not named"
exit 0
