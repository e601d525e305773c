#!/bin/sh
# A desync by fault injection: one bit of one body flips on the client at a frame, and both peers' bundles must name it.
# SPDX-License-Identifier: MIT
# usage: fault_injection_test.sh TOOL
set -u
tool=$1
. "$(dirname "$0")/common.sh"

match="$patient --frames 260 --scalar q32.32 --trace"
# Word splitting is wanted.
start_host host $match --bundle "$dir/host.bundle"
"$tool" peer --connect "127.0.0.1:$port" --profile latency=60,jitter=20,loss=5 $match --bot 2 --fault 150 \
  --bundle "$dir/client.bundle" 2>"$dir/client.err" >/dev/null
client=$?
wait "$host"
host=$?
[ "$host" -eq 1 ] && [ "$client" -eq 1 ] || fail "the peers exit with $host and $client, not with 1 for a desync"
grep -q "DESYNC: player 1 " "$dir/host.err" || fail "the host does not name the player"
grep -q "DESYNC: the host " "$dir/client.err" || fail "the client does not name the host"

"$tool" diff "$dir/host.bundle" "$dir/client.bundle" >"$dir/diff.err"
[ $? -eq 1 ] || fail "diff does not exit with 1"
grep -q "^frame 150, stage commands" "$dir/diff.err" || fail "diff names another frame or stage"
grep -q "bodies\[[0-9]*\]\..* apart \[body slot [0-9]*\]" "$dir/diff.err" || fail "diff names no field and body"
grep -q "as A recorded it" "$dir/diff.err" || fail "diff does not say whose frame this machine makes"
head -n 4 "$dir/diff.err"
