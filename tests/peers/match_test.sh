#!/bin/sh
# Real processes over UDP: a host and clients whose lines are bad play one match; all hashes are equal, all replays hold.
# SPDX-License-Identifier: MIT
# usage: match_test.sh TOOL PLAYERS FRAMES SCALAR PROFILE
set -u
tool=$1 players=$2 frames=$3 scalar=$4 profile=$5
[ "${ISOSTEP_WHOLE:-}" = 1 ] || frames=$((frames / 4))  # a sample
. "$(dirname "$0")/common.sh"

match="$patient --players $players --frames $frames --scalar $scalar --json"
# Word splitting is wanted: no argument holds a space.
start_host 0 $match --bot 1 --hashes "$dir/0.txt" --record "$dir/0.replay"
pids=$host
for p in $(seq 1 $((players - 1))); do
  "$tool" peer --connect "127.0.0.1:$port" --profile "$profile" $match --bot $((p + 1)) --hashes "$dir/$p.txt" \
    --record "$dir/$p.replay" >"$dir/$p.out" 2>"$dir/$p.err" &
  pids="$pids $!"
done
for pid in $pids; do
  wait "$pid" || fail "a peer exits with $?"
done

for p in $(seq 0 $((players - 1))); do
  [ "$(wc -l <"$dir/$p.txt")" -eq "$frames" ] || fail "peer $p has $(wc -l <"$dir/$p.txt") hashes"
  cmp -s "$dir/0.txt" "$dir/$p.txt" || fail "the hashes of peers 0 and $p differ"
done
[ "$(cut -d ' ' -f 2 "$dir/0.txt" | sort -u | wc -l)" -eq "$frames" ] || fail "some frames have the same hash"
"$tool" verify "$dir"/*.replay || fail "a replay does not verify"
sed 's/"depths":[^]]*],//' "$dir"/*.out
