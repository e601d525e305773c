#!/bin/sh
# JavaScript beside C++: three runs of each in turn, of every figure the least.
# usage: costs.sh FOLDER NATIVE SCALAR [LANES]
# SPDX-License-Identifier: MIT
#
# FOLDER: where the npm package is installed. LANES: NATIVE's kernels, sse2 unless told, for WebAssembly's are as wide.
set -u
here=$(dirname "$0")
runs=$(mktemp) || exit 70
trap 'rm -f "$runs"' EXIT
for _ in 1 2 3; do
  native=$("$2" "$3" "${4:-sse2}") || exit 1
  printf '%s\n' "$native" | sed 's/^/C++ /' >>"$runs"
  wasm=$(node --no-liftoff "$here/costs.mjs" "$1" "$3") || exit 1
  printf '%s\n' "$wasm" | sed 's/^/JavaScript /' >>"$runs"
done
awk '{name = $1 " " $2; if (!(name in least)) order[++count] = name
  if (!(name in least) || $3 + 0 < least[name]) {least[name] = $3 + 0; line[name] = $0}}
  END {for (i = 1; i <= count; ++i) print line[order[i]]}' "$runs"
