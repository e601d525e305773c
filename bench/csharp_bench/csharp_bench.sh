#!/bin/sh
# C# beside C++: five runs of each in turn, of every figure the least.
# usage: csharp_bench.sh REPOSITORY LIBISOSTEP NATIVE
set -u
. "$1/tests/scratch.sh"
. "$1/tests/csharp/family.sh"
assembly "$1" "$2"
each_family "$1/tests/csharp/Hello.cs.in" Hello
mcs -unsafe -optimize+ -r:"$dir/Isostep.dll" -out:"$dir/bench.exe" "$dir"/Hello*.cs "$1/bench/csharp_bench/Bench.cs" \
  >"$dir/out" 2>&1 || fail "the benchmark does not compile"
for run in 1 2 3 4 5; do
  "$3" | sed 's/^/C++ /' || fail "native fails"
  mono "$dir/bench.exe" | sed 's/^/C#  /' || fail "bench.exe fails"
done >"$dir/runs"
awk '{value = $0; sub(/^(C\+\+|C#) +/, "", value); number = value; sub(/^[^0-9]*(32 )?/, "", number)
  match(value, /[0-9]+\.[0-9]+/); figure = substr(value, RSTART, RLENGTH) + 0; key = $1 " " substr(value, 1, RSTART - 1)
  if (!(key in least) || figure < least[key]) {least[key] = figure; line[key] = $0}}
  END {for (key in line) print line[key]}' "$dir/runs" | sort -k2
