#!/bin/sh
# controls.sh GATE OBJDUMP NM CXX [FLAGS...]: that the gate sees on this target what it must, and lets pass what it may.
# SPDX-License-Identifier: MIT
#
# Compiles every file of controls/ that the target has instructions or libraries for, one object a concern, and ends
# with 1 when the gate misses a concern, sees another, or finds something in clean.cpp.
set -u
[ "$#" -ge 4 ] || { echo "usage: controls.sh GATE OBJDUMP NM CXX [FLAGS...]" >&2; exit 64; }
gate=$1 objdump=$2 nm=$3 cxx=$4
shift 4
controls=$(dirname "$0")/controls
dir=$(mktemp -d) || exit 70
trap 'rm -rf "$dir"' EXIT
trap 'exit 130' INT TERM HUP

"$cxx" "$@" -dM -E -x c++ /dev/null >"$dir/macros" || exit 70
has() { grep -Eq "^#define ($1) " "$dir/macros"; }

concerns='fused libm'
if has '__x86_64__|__i386__'; then concerns="$concerns x87 loose unpinned"; fi
if has '__arm__'; then concerns="$concerns flushes"; fi
if has '__aarch64__|__riscv|__powerpc64__|__wasm__'; then concerns="$concerns soft"; fi

# concern_of NAME: its own; but LLVM's objdump, 19's too, does not know the opcodes that WebAssembly 3.0 gave its relaxed
# operations, which clang writes from 16 on.
concern_of() {
  clang=$(sed -n 's/^#define __clang_major__ //p' "$dir/macros")
  if [ "$1" = fused ] && has __wasm__ && [ "${clang:-0}" -ge 16 ]; then echo unknown; else echo "$1"; fi
}

status=0
# check NAME FLAG GATE'S WORDS...
check() {
  name=$1 contraction=$2
  shift 2
  if "$gate" "$@" "$objdump" "$nm" "$dir/$name.o" >"$dir/said" 2>&1; then
    echo "$name: as it must be: $(tail -n 1 "$dir/said")"
  else
    echo "$name ($contraction): the gate is wrong, or the flags are:" && cat "$dir/said" && status=1
  fi
}
for name in clean $concerns; do
  contraction=-ffp-contract=fast
  if [ "$name" = clean ]; then contraction=-ffp-contract=off; fi
  "$cxx" "$@" -std=c++20 -O2 -fno-lto $contraction -c "$controls/$name.cpp" -o "$dir/$name.o" || exit 70
  if [ "$name" = clean ]; then check clean $contraction; else check "$name" $contraction --finds "$(concern_of "$name")"; fi
done
exit $status
