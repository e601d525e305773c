#!/bin/sh
# The shared library exports what isostep.h declares, and nothing else; it needs the C library alone.
# usage: symbols_test.sh LIBRARY ABI.TXT NM OBJDUMP
# SPDX-License-Identifier: MIT
set -u
. "$(dirname "$0")/../scratch.sh"
library=$1 abi=$2 nm=$3 objdump=$4
"$nm" -D --defined-only "$library" | awk '$2 != "A" {sub("@.*", "", $3); print $3}' | sort >"$dir/exported"
awk '$1 == "function" {print $2}' "$abi" | sort >"$dir/declared"
[ "$(wc -l <"$dir/declared")" -gt 1000 ] || { echo "symbols: too few functions are declared" >&2; exit 1; }
comm -13 "$dir/declared" "$dir/exported" | sed 's/^/exported and not declared: /' >"$dir/findings"
comm -23 "$dir/declared" "$dir/exported" | sed 's/^/declared and not exported: /' >>"$dir/findings"
"$objdump" -p "$library" | awk '$1 == "NEEDED" && $2 !~ /^(libc\.so|ld-linux|libm\.so|libgcc_s|libstdc|lib[a-z]*san)/ {
  print "needs " $2}' >>"$dir/findings"
"$objdump" -p "$library" | grep -q 'SONAME *libisostep\.so\.[0-9]*$' || echo "its soname is not libisostep.so.N" >>"$dir/findings"
cat "$dir/findings" >&2
[ ! -s "$dir/findings" ]
