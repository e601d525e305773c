#!/bin/sh
# pages_test.sh FOLDER REPOSITORY: the blocks of js of src/js/README.md run, one by one, where the package is installed;
# the example, of which the blocks of ts are (tests/readme), compiles strictly and plays.
# SPDX-License-Identifier: MIT
set -u
. "$2/tests/scratch.sh"
page=$2/src/js/README.md
work=$1/pages
rm -rf "$work"
mkdir -p "$work" || exit 1

awk -v to="$work/block" '/^```js$/ {inside = 1; n += 1; file = to n ".mjs"; next} /^```$/ {inside = 0}
  inside {print >file}' "$page"
blocks=0
for block in "$work"/block*.mjs; do
  [ -f "$block" ] || fail "the page has no block of js"
  (cd "$work" && node "$block" >said 2>&1) || fail "$(cat "$block"; cat "$work/said")"
  blocks=$((blocks + 1))
done

cp "$2"/src/js/example/* "$2/tests/js/types_test.ts" "$work" || exit 1
(cd "$work" && node "$1/node_modules/typescript/bin/tsc" -p .) || fail "the example or types_test.ts does not compile"
said=$(cd "$work" && node out/match.js) || fail "match.ts: $said"
echo "$said"
port=$((20000 + $$ % 10000))
(cd "$work" && node out/online.js host "$port" >host.out 2>host.err) &
host=$!
tries=0
while ! grep -q ":$(printf '%04X' "$port") " /proc/net/tcp /proc/net/tcp6 2>/dev/null && [ "$tries" -lt 600 ]; do
  sleep 0.1
  tries=$((tries + 1))
done
(cd "$work" && node out/online.js "ws://127.0.0.1:$port" >client.out 2>client.err) ||
  fail "online.ts: $(cat "$work/client.err")"
wait "$host" || fail "online.ts host: $(cat "$work/host.err")"
[ -s "$work/host.out" ] && cmp "$work/host.out" "$work/client.out" || fail "online.ts: the hashes differ"
echo "$blocks blocks run, the example compiles and plays"
