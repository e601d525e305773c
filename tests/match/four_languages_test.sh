#!/bin/sh
# One match with a host in C++ and clients in C, C# and JavaScript.
# usage: four_languages_test.sh REPOSITORY PACKAGE MATCH_HOST ISOSTEP LIBISOSTEP C_CLIENT FOLDER SCALAR
# PACKAGE: of C#. C_CLIENT: its path less _SCALAR. FOLDER: where npm has installed the package and ws. Exits 77 where one
# is missing.
set -u
. "$1/tests/scratch.sh"
. "$1/tests/csharp/family.sh"
root=$1 package=$2 host=$3 isostep=$4 library=$5 c_client="'$6_$8'" folder=$7 scalar=$8
for program in node mono mcs; do
  command -v "$program" >/dev/null 2>&1 || skip "no $program"
done
[ -f "$folder/node_modules/isostep/wasm/isostep.$scalar.wasm" ] ||
  skip "no WebAssembly module in $folder: run ./isostep package"
[ -d "$folder/node_modules/ws" ] || skip "no ws in $folder"
puck_client "$root" "$package" "$library"
sh "$root/tests/match/match_test.sh" "$host" "$isostep" "$scalar" "$c_client" "mono '$dir/client.exe' $scalar" \
  "node --no-warnings '$root/tests/js/puck_client.mjs' '$folder' $scalar" || exit 1
# A match whose client plays by other rules is none.
"$host" "$scalar" latency=150,jitter=40,loss=5 600 "$dir" "$c_client forgets" >"$dir/out" 2>"$dir/err" &&
  fail "a client that forgets is not found out"
grep -Eq 'desync|another state|differs' "$dir/err" || fail "a client that forgets fails by something else"
