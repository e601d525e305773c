#!/bin/sh
# A match over IPv6: a relay in front of the host, and one that the client has of its own.
# SPDX-License-Identifier: MIT
# usage: ipv6_test.sh TOOL
set -u
tool=$1
. "$(dirname "$0")/common.sh"

match="$patient --frames 120 --scalar float"
# Word splitting is wanted.
start_host host $match --hashes "$dir/host.txt"
"$tool" relay --bind ::1 --target "127.0.0.1:$port" --profile loopback --port-file "$dir/relay.port" >"$dir/relay.out" \
  2>"$dir/relay.err" &
relay=$!
trap 'kill -KILL $host $relay 2>/dev/null; rm -rf "$dir"' EXIT # where the test fails, nobody else ends them
come_up() { [ -s "$dir/relay.port" ] || has_ended "$relay"; }
wait_until "the relay neither writes its port nor ends" come_up
[ -s "$dir/relay.port" ] || skip "this system has no IPv6: $(cat "$dir/relay.err")"
"$tool" peer --connect "[::1]:$(cat "$dir/relay.port")" $match --bot 2 --hashes "$dir/client.txt" >"$dir/client.out" \
  2>"$dir/client.err" || fail "the client exits with $?"
wait "$host" || fail "the host exits with $?"
cmp "$dir/host.txt" "$dir/client.txt" || fail "the hashes differ"
[ "$(wc -l <"$dir/client.txt")" -eq 120 ] || fail "the client has $(wc -l <"$dir/client.txt") hashes"
