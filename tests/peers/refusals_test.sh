#!/bin/sh
# What a peer refuses: words that cannot be, hosts that are not there, and matches that are not the same.
# SPDX-License-Identifier: MIT
# usage: refusals_test.sh TOOL
set -u
tool=$1
. "$(dirname "$0")/common.sh"

failures=0
# refuses STATUS WORDS-IN-THE-MESSAGE ARGUMENTS...
refuses() {
  wanted=$1 message=$2
  shift 2
  "$tool" "$@" >"$dir/out" 2>"$dir/err"
  status=$?
  if [ "$status" -ne "$wanted" ] || ! grep -q -- "$message" "$dir/err" || [ -s "$dir/out" ]; then
    echo "isostep $*: exits $status and says:" >&2
    cat "$dir/err" >&2
    failures=$((failures + 1))
  fi
}

refuses 64 "either listens or connects" peer
refuses 64 "either listens or connects" peer --listen 0 --connect 127.0.0.1:9
refuses 64 "no HOST:PORT" peer --connect 127.0.0.1
refuses 64 "no HOST:PORT" peer --connect 127.0.0.1:0
refuses 64 "no HOST:PORT" peer --connect :4000
refuses 64 "no HOST:PORT" peer --connect 127.0.0.1:70000
refuses 64 "profile" peer --connect 127.0.0.1:9 --profile latency=fast
refuses 64 "profile" peer --listen 0 --profile mobile
refuses 64 "players" peer --listen 0 --players 9
refuses 64 "delay" peer --listen 0 --delay 21
refuses 66 "no host answers" peer --connect 127.0.0.1:9 --patience 1 --frames 10
refuses 74 "" peer --listen 0 --record "$dir/none/a.replay"
refuses 74 "" peer --listen 0 --hashes "$dir/none/a.txt"
refuses 74 "" peer --listen 0 --bundle "$dir/none/a.bundle"
refuses 64 "no HOST:PORT" relay --target nowhere
printf '1 2 0 0\n1 2 300 0\n' >"$dir/inputs"
refuses 64 "inputs:2: expected" peer --listen 0 --inputs "$dir/inputs"
refuses 66 "none" peer --listen 0 --inputs "$dir/none"

# refused_for FIELD HOST-ARGUMENTS -- CLIENT-ARGUMENTS
refused_for() {
  field=$1 host_words=$2 client_words=$3
  # Word splitting is wanted.
  start_host host $patient --frames 100 $host_words
  refuses 66 "refused: $field is" peer $patient --connect "127.0.0.1:$port" --frames 100 $client_words
  await "refused: $field is" host
  kill "$host"
  wait "$host" 2>/dev/null
}
refused_for scalar "--scalar float" "--scalar double"
refused_for pile "--pile 10" "--pile 11"
refused_for match_seed "" "--match-seed 2"
refused_for players "--players 3" "--players 2"

[ "$failures" -eq 0 ] && echo "every refusal names its reason"
exit "$failures"
