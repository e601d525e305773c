#!/bin/sh
# C# beside C++: three runs of each in turn, of every figure the least.
# usage: csharp_bench.sh REPOSITORY LIBISOSTEP NATIVE
set -u
. "$1/tests/scratch.sh"
. "$1/tests/csharp/family.sh"
assembly "$1" "$2"
each_family "$1/tests/csharp/Hello.cs.in" Hello
mcs -unsafe -optimize+ -r:"$dir/Isostep.dll" -out:"$dir/bench.exe" "$dir"/Hello*.cs "$1/bench/csharp_bench/Bench.cs" \
  >"$dir/out" 2>&1 || fail "the benchmark does not compile"
for _ in 1 2 3; do
  "$3" >"$dir/out" 2>&1 || fail "the C++ side fails"
  sed 's/^/C++ /' "$dir/out" >>"$dir/runs"
  mono "$dir/bench.exe" >"$dir/out" 2>&1 || fail "the C# side fails"
  sed 's/^/C#  /' "$dir/out" >>"$dir/runs"
done
awk '{language = $1; sub(/^[^ ]+ +/, ""); match($0, /[0-9]+[.][0-9]+/)
  name = language " " substr($0, 1, RSTART - 1); figure = substr($0, RSTART, RLENGTH) + 0
  if (!(name in least) || figure < least[name]) {least[name] = figure; line[name] = language " " $0}}
  END {for (name in line) print line[name]}' "$dir/runs" | sort -k2
