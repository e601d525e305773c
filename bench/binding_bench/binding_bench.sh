#!/bin/sh
# C# and Python beside C++: three runs of each in turn, of every figure the least.
# usage: binding_bench.sh REPOSITORY LIBISOSTEP NATIVE
set -u
. "$1/tests/scratch.sh"
. "$1/tests/csharp/family.sh"
assembly "$1" "$2"
each_family "$1/tests/csharp/Hello.cs.in" Hello
mcs -unsafe -optimize+ -r:"$dir/Isostep.dll" -out:"$dir/bench.exe" "$dir"/Hello*.cs "$1/bench/binding_bench/Bench.cs" \
  >"$dir/out" 2>&1 || fail "the benchmark does not compile"
mkdir "$dir/isostep"
cp "$1"/src/python/isostep/*.py "$1/src/c/interface.json" "$dir/isostep"
python=/usr/bin/python3  # the system's has numpy
[ -x "$python" ] || python=python3

# run LANGUAGE COMMAND...: its lines, with the language before each.
run() {
  language=$1
  shift
  "$@" >"$dir/out" 2>&1 || fail "the side in $language fails"
  sed "s/^/$language /" "$dir/out" >>"$dir/runs"
}
for _ in 1 2 3; do
  run C++ "$3"
  run C# mono "$dir/bench.exe"
  run Python env PYTHONPATH="$dir" ISOSTEP_LIBRARY="$dir/libisostep.so" "$python" "$1/bench/binding_bench/bench.py"
done
awk '{language = $1; sub(/^[^ ]+ +/, ""); match($0, /[0-9]+[.][0-9]+/)
  unit = substr($0, RSTART + RLENGTH); sub(/,.*/, "", unit)
  name = language " " substr($0, 1, RSTART - 1) unit; figure = substr($0, RSTART, RLENGTH) + 0
  if (!(name in least) || figure < least[name]) {least[name] = figure; line[name] = language " " $0}}
  END {for (name in line) print line[name]}' "$dir/runs" | sort -k2
