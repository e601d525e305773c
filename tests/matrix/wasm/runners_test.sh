#!/bin/sh
# runners_test.sh: what Node and Chromium are given comes out of them: words, files, standard input, exit codes.
# SPDX-License-Identifier: MIT
set -u
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../../scratch.sh"
cd "$dir" || exit 1

command -v node >/dev/null 2>&1 || skip "no node"
for compiler in clang++ clang++-16 none; do
  if "$compiler" --target=wasm32-wasi -fno-exceptions -O1 "$here/echo.cpp" -o echo.wasm 2>compiler.err; then break; fi
done
[ -s echo.wasm ] || skip "no clang with wasi-libc: $(head -n 1 compiler.err)"

printf 'abc' >small
head -c 200000 "$(command -v node)" >large

# check NAME COMMAND...: the runner before a module.
check() {
  name=$1
  shift
  printf 'from a pipe' | "$@" echo.wasm 3 small "$dir/large" - >said 2>err
  status=$?
  [ "$status" = 3 ] || fail "$name ends with $status instead of 3: $(cat said err)"
  sum=$(((97 * 31 * 31 + 98 * 31 + 99) % 1000003))
  [ "$(sed -n 1p said)" = "small 3 $sum 3" ] || fail "$name reads small as: $(sed -n 1p said)"
  [ "$(sed -n "2s|^$dir/||p" said | cut -d ' ' -f 1,2,4)" = "large 200000 200000" ] || fail "$name: $(sed -n 2p said)"
  [ "$(sed -n 3p said | cut -d ' ' -f 1,2)" = "- 11" ] || fail "$name reads its input as: $(sed -n 3p said)"
  [ "$(wc -l <said)" -eq 3 ] || fail "$name says: $(cat said)"
  cp said "said.$name"

  "$@" echo.wasm 0 nothing >said 2>err
  status=$?
  [ "$status" = 2 ] || fail "$name: a file that is not there ends with $status: $(cat said err)"
  grep -q '^no nothing$' err || fail "$name: what the program says on stderr is lost: $(cat err)"
  "$@" echo.wasm 0 >said 2>err || fail "$name: 0 comes out as $?: $(cat err)"
  "$@" echo.wasm clock >said 2>err || fail "$name: time stands still: $(cat err)"
  "$@" echo.wasm trap >said 2>err
  status=$?
  [ "$status" = 70 ] || fail "$name: a trap ends with $status"
  "$@" nothing.wasm >said 2>err
  status=$?
  [ "$status" = 70 ] || fail "$name: no module ends with $status"
  "$@" >said 2>err
  status=$?
  [ "$status" = 64 ] || fail "$name: no words end with $status"
}

check node node --no-warnings "$here/run_node.mjs"
CHROMIUM=/nothing node "$here/run_chromium.mjs" echo.wasm 0 2>/dev/null && fail "a browser that is not there runs"
node "$here/run_chromium.mjs" echo.wasm 0 >said 2>err
[ "$?" != 69 ] || skip "Node does as it must; $(cat err)"
check chromium node "$here/run_chromium.mjs"
cmp said.node said.chromium || fail "Node and Chromium differ"
