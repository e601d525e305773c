#!/bin/sh
# Worlds through the C# classes, in all four scalars.
# usage: world_test.sh REPOSITORY PACKAGE LIBISOSTEP HELLO_HASHES LAYOUTS
set -u
. "$1/tests/scratch.sh"
. "$1/tests/csharp/family.sh"
assembly "$2" "$3"
here=$1/tests/csharp
each_family "$here/Hello.cs.in" Hello
mcs -warnaserror -unsafe -optimize+ -r:"$dir/Isostep.dll" -out:"$dir/world.exe" "$dir"/Hello*.cs "$here/WorldTest.cs" \
  "$here/Layout.cs" "$5/LayoutTable.cs" >"$dir/out" 2>&1 || fail "the test does not compile"
mono "$dir/world.exe" hello >"$dir/managed" 2>"$dir/err" || fail "hello fails"
"$4" >"$dir/native" || fail "hello_hashes fails"
[ "$(wc -l <"$dir/native")" -eq 964 ] || fail "hello_hashes prints another number of frames"
cmp "$dir/managed" "$dir/native" >"$dir/out" 2>&1 || fail "hello has other hashes in C#"
mono "$dir/world.exe" all >"$dir/out" 2>"$dir/err" || fail "a world does not do what it should"
cat "$dir/out"
