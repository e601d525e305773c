#!/bin/sh
# A player leaves a running match and another process takes the seat: it catches up, and all its hashes are the host's.
# SPDX-License-Identifier: MIT
# usage: rejoin_test.sh TOOL
set -u
tool=$1
. "$(dirname "$0")/common.sh"

match="--frames 720 --scalar float"
# Word splitting is wanted.
start_host host $match --bot 1 --hashes "$dir/host.txt" --record "$dir/host.replay"
"$tool" peer --connect "127.0.0.1:$port" --profile wifi $match --bot 2 --hashes "$dir/first.txt" >"$dir/first.out" \
  2>"$dir/first.err" &
first=$!
"$tool" peer --connect "127.0.0.1:$port" --profile wifi $match --spectate --hashes "$dir/watcher.txt" \
  >"$dir/watcher.out" 2>"$dir/watcher.err" &
watcher=$!
await "joined: player 1" host
sleep 2
kill -INT "$first"
wait "$first"
[ $? -eq 130 ] || fail "an interrupted peer exits with $?"
"$tool" peer --connect "127.0.0.1:$port" --profile wifi $match --bot 3 --hashes "$dir/second.txt" --record "$dir/second.replay" \
  >"$dir/second.out" 2>"$dir/second.err" || fail "the second player exits with $?"
wait "$watcher" || fail "the spectator exits with $?"
wait "$host" || fail "the host exits with $?"

for peer in first second watcher; do
  [ -s "$dir/$peer.txt" ] || fail "$peer has no hashes"
  [ "$(grep -F -x -c -f "$dir/host.txt" "$dir/$peer.txt")" -eq "$(wc -l <"$dir/$peer.txt")" ] || fail "$peer saw another match"
done
grep -q "left: player 1" "$dir/host.err" || fail "the host did not see player 1 leave"
[ "$(grep -c "joined: player 1" "$dir/host.err")" -ge 2 ] || fail "player 1 did not come back"
grep -q "joined: player 1" "$dir/second.err" || fail "the second player never played"
"$tool" verify "$dir"/*.replay
