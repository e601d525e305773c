#!/bin/sh
# limits_test.sh TOOL: verify ends by its caps, with a status and words of its own, however large the world in a file is.
# SPDX-License-Identifier: MIT
set -u
tool=$1
. "$(dirname "$0")/../scratch.sh"

"$tool" run S5 --frames 20 --record "$dir/crowd.replay" >"$dir/out" 2>"$dir/err" || fail "run --record ends with $?"

# expect STATUS WORDS OPTIONS...
expect() {
  status=$1 words=$2
  shift 2
  "$tool" verify "$@" >"$dir/out" 2>"$dir/err"
  ended=$?
  [ "$ended" = "$status" ] || fail "verify $* ends with $ended, not $status"
  grep -q -e "$words" "$dir/out" || fail "verify $* does not say: $words"
}

expect 0 '^1 of 1 verified' --max-seconds 100000 "$dir/crowd.replay"
expect 5 'STOPPED before frame [0-9]*: --max-seconds' --max-seconds 0.001 "$dir/crowd.replay"
expect 5 '^0 of 2 verified' --max-seconds 0.001 --jobs 2 "$dir/crowd.replay" "$dir/crowd.replay"
expect 5 '"outcome":"stopped".*"exit":5' --json --max-seconds 0.001 "$dir/crowd.replay"
[ "$(uname)" = Linux ] || exit 0
expect 0 '^1 of 1 verified' --max-memory 8192 "$dir/crowd.replay"
expect 5 'STOPPED before frame 0: --max-memory' --max-memory 1 "$dir/crowd.replay"
