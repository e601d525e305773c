#!/bin/sh
# The gate of the symbols passes a library of functions that do nothing, and finds one dropped, one too many, another
# soname and another dependency.
# usage: symbols_gate_test.sh ABI.TXT CC NM OBJDUMP
# SPDX-License-Identifier: MIT
set -u
. "$(dirname "$0")/../scratch.sh"
gate=$(dirname "$0")/symbols_test.sh
abi=$1 cc=$2 nm=$3 objdump=$4
failures=0
complain() {
  echo "symbols gate: $1" >&2
  failures=$((failures + 1))
}
# library NAME FLAGS...: of the functions in $dir/functions.
library() {
  name=$1
  shift
  sed 's/.*/void &(void) {}/' "$dir/functions" >"$dir/$name.c"
  "$cc" -shared -fPIC "$dir/$name.c" -o "$dir/$name.so" "$@" || fail "$name does not compile"
}
found() { # what, library, what it says
  if sh "$gate" "$dir/$2.so" "$abi" "$nm" "$objdump" 2>"$dir/said"; then complain "lets $1 through"
  elif ! grep -Fqx "$3" "$dir/said"; then complain "says of $1: $(cat "$dir/said")"; fi
}
awk '$1 == "function" {print $2}' "$abi" >"$dir/all"
soname=-Wl,-soname,libisostep.so.0

cp "$dir/all" "$dir/functions" && library whole $soname
sh "$gate" "$dir/whole.so" "$abi" "$nm" "$objdump" || complain "refuses a library that has all functions"
grep -vx iso_world_step "$dir/all" >"$dir/functions" && library dropped $soname
found "a dropped symbol" dropped "declared and not exported: iso_world_step"
{ cat "$dir/all"; echo iso_world_leap; } >"$dir/functions" && library more $soname
found "a symbol that no header has" more "exported and not declared: iso_world_leap"
cp "$dir/all" "$dir/functions" && library unnamed
found "a library without its name" unnamed "its soname is not libisostep.so.N"
echo other >"$dir/functions" && library libother -Wl,-soname,libother.so.1
cp "$dir/all" "$dir/functions" && library needy $soname -Wl,--no-as-needed "$dir/libother.so"
found "a dependency" needy "needs libother.so.1"

[ "$failures" -eq 0 ] && echo "symbols gate: finds what it should"
exit "$failures"
