#!/bin/sh
# Peers that stop without a word: a client that is stopped for longer than anybody waits comes back and plays on; a client
# whose host dies gives up when its patience ends.
# SPDX-License-Identifier: MIT
# usage: crash_test.sh TOOL
set -u
tool=$1
. "$(dirname "$0")/common.sh"

# Word splitting is wanted.
start_host host --frames 1000000 --scalar float --hashes "$dir/host.txt"
"$tool" peer --connect "127.0.0.1:$port" --profile lan $endless --scalar float --bot 2 --hashes "$dir/client.txt" \
  >"$dir/client.out" 2>"$dir/client.err" &
client=$!
await "is final" client
kill -STOP "$client"
await "left: player 1" host  # which waits for five seconds by itself
kill -CONT "$client"
await "joined: player 1" client 2
interrupt "the client" "$client"
interrupt "its host" "$host"
same_history host client

start_host host --frames 1000000 --scalar float
"$tool" peer --connect "127.0.0.1:$port" --patience 4 --frames 1000000 --scalar float >"$dir/client.out" \
  2>"$dir/client.err" &
client=$!
await "joined: player 1" host
kill -KILL "$host"
wait "$client"
[ $? -eq 66 ] || fail "a client without its host exits with $?"
grep -q "lost the host" "$dir/client.err" || fail "the client does not tell"
grep -q "the host is gone" "$dir/client.err" || fail "the client does not say why it ends"
