#!/bin/sh
# The recording of a match in C is verified by the stock tool, and one with a changed byte is not.
# usage: verify_test.sh RECORD_PUCK_MATCH ISOSTEP
set -eu
record=$1 isostep=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$record" "$folder/match.replay"
"$isostep" verify "$folder/match.replay"
size=$(wc -c <"$folder/match.replay")
for at in 40 $((size / 3)) $((size / 2)) $((size - 30)); do
  cp "$folder/match.replay" "$folder/altered.replay"
  byte=$(od -An -tu1 -j "$at" -N 1 "$folder/match.replay" | tr -d ' ')
  printf "\\$(printf %o $(((byte + 1) % 256)))" |
    dd of="$folder/altered.replay" bs=1 seek="$at" conv=notrunc 2>/dev/null
  if "$isostep" verify "$folder/altered.replay" >/dev/null 2>&1; then
    echo "byte $at was changed, and the recording is verified all the same"
    exit 1
  fi
done
