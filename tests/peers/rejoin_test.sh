#!/bin/sh
# A player leaves a running match and another process takes the seat: it catches up, and all its hashes are the host's.
# SPDX-License-Identifier: MIT
# usage: rejoin_test.sh TOOL
set -u
tool=$1
. "$(dirname "$0")/common.sh"

match="$endless --scalar float --replayed 0" # who comes late is sent a snapshot
# Word splitting is wanted.
start_host host $match --reservation 0 --bot 1 --hashes "$dir/host.txt" --record "$dir/host.replay"
# join NAME WORDS...: sets `joined` to its process.
join() {
  name=$1
  shift
  "$tool" peer --connect "127.0.0.1:$port" --profile wifi $match --hashes "$dir/$name.txt" "$@" >"$dir/$name.out" \
    2>"$dir/$name.err" &
  joined=$!
}
join first --bot 2
first=$joined
join watcher --spectate
watcher=$joined
await "is final" first
await "is final" watcher
interrupt "the first player" "$first"
await "left: player 1" host
join second --bot 3 --record "$dir/second.replay"
second=$joined
await "joined: player 1" host 2
await "joined: player 1" second
await "is final" second
grep -q "goes on from a snapshot" "$dir/second.err" || fail "the second player tells of no snapshot"
interrupt "the second player" "$second"
interrupt "the spectator" "$watcher"
interrupt "the host" "$host"

for peer in first second watcher; do same_history host "$peer"; done
"$tool" verify "$dir"/*.replay
