#!/bin/sh
# Matches through the C# classes, over the simulated network and over UDP where that is built.
# usage: sessions_test.sh REPOSITORY PACKAGE LIBISOSTEP [LIBISOSTEP_UDP]
set -u
. "$1/tests/scratch.sh"
. "$1/tests/csharp/family.sh"
assembly "$2" "$3"
which=here
if [ $# -gt 3 ]; then
  # Both names are one file, so that the process has one library.
  ln -s libisostep.so "$dir/libisostep.so.0" && cp "$4" "$dir/libisostep_udp.so" || fail "no $4"
  which=udp
fi
mcs -warnaserror -r:"$dir/Isostep.dll" -out:"$dir/sessions.exe" "$1/tests/csharp/SessionsTest.cs" >"$dir/out" 2>&1 ||
  fail "the test does not compile"
mono "$dir/sessions.exe" "$which" >"$dir/out" 2>"$dir/err" || fail "a session does not do what it should"
cat "$dir/out"
