#!/bin/sh
# A match of a C++ host and clients: 3600 frames across 150 ms +-40 each way, 5 % lost. All peers have the same hashes,
# and everybody's recording is verified by the stock tool.
# usage: match_test.sh MATCH_HOST ISOSTEP SCALAR CLIENT...
set -u
. "$(dirname -- "$0")/../scratch.sh"
host=$1 isostep=$2 scalar=$3
shift 3
"$host" "$scalar" latency=150,jitter=40,loss=5 3600 "$dir" "$@" >"$dir/out" 2>"$dir/err" || fail "the match fails"
cat "$dir/out"
"$isostep" verify "$dir"/*.replay >"$dir/out" 2>"$dir/err" || fail "a recording is not verified"
[ "$(ls "$dir"/*.replay | wc -l)" -eq $(($# + 1)) ] || fail "a recording is missing"
cat "$dir/out"
