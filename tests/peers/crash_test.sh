#!/bin/sh
# Peers that stop without a word: a client that is stopped for longer than anybody waits comes back and plays on; a client
# whose host dies gives up when its patience ends.
# SPDX-License-Identifier: MIT
# usage: crash_test.sh TOOL
set -u
tool=$1
. "$(dirname "$0")/common.sh"

match="--frames 1080 --scalar float"
# Word splitting is wanted.
start_host host $match --hashes "$dir/host.txt"
"$tool" peer --connect "127.0.0.1:$port" --profile lan $match --bot 2 --hashes "$dir/client.txt" >"$dir/client.out" \
  2>"$dir/client.err" &
client=$!
await "joined: player 1" host
sleep 1
kill -STOP "$client"
sleep 7
kill -CONT "$client"
wait "$client" || fail "the client that was stopped exits with $?"
wait "$host" || fail "its host exits with $?"
[ "$(grep -F -x -c -f "$dir/host.txt" "$dir/client.txt")" -eq "$(wc -l <"$dir/client.txt")" ] || fail "they saw two matches"
grep -q "left: player 1" "$dir/host.err" || fail "the host went on waiting"
[ "$(grep -c "joined: player 1" "$dir/host.err")" -ge 2 ] || fail "the client did not come back"

start_host host $match
"$tool" peer --connect "127.0.0.1:$port" --patience 4 $match >"$dir/client.out" 2>"$dir/client.err" &
client=$!
await "joined: player 1" host
kill -KILL "$host"
wait "$client"
[ $? -eq 66 ] || fail "a client without its host exits with $?"
grep -q "lost the host" "$dir/client.err" || fail "the client does not tell"
grep -q "the host is gone" "$dir/client.err" || fail "the client does not say why it ends"
