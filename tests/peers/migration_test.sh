#!/bin/sh
# The host's process is killed, and of four peers later also that of the one that followed it: the others play on, with
# one history of all frames, and their recordings hold.
# SPDX-License-Identifier: MIT
# usage: migration_test.sh TOOL PLAYERS [MODE]
set -u
tool=$1 players=$2
shift 2
. "$(dirname "$0")/common.sh"

match="$endless --migration 2 --players $players --scalar float $*"
last=$((players - 1))
# Word splitting is wanted: no argument holds a space.
start_host 0 $match --bot 1
pid_0=$host pids=$host
trap 'kill -KILL $pids 2>/dev/null; rm -rf "$dir"' EXIT # where the test fails, nobody else ends them
for p in $(seq 1 $last); do
  "$tool" peer --connect "127.0.0.1:$port" $match --bot $((p + 1)) --hashes "$dir/$p.txt" --record "$dir/$p.replay" \
    >"$dir/$p.out" 2>"$dir/$p.err" &
  eval "pid_$p=\$!"
  pids="$pids $!"
done

# kill_host DEAD MACHINES TIMES LIVING...: once all know who is there, and play. Until all have found another, and play on.
# Sets `next` to the peer that is the host.
kill_host() {
  dead=$1 machines=$2 times=$3
  shift 3
  for p in "$@"; do
    await "another host: $machines\$" "$p"
    await "is final" "$p"
  done
  eval "kill -KILL \$pid_$dead; host=\$pid_$1"
  next=
  for p in "$@"; do
    await "new host: player" "$p" "$times"
    await "first one with the new host" "$p" "$times"
    if grep -q "^isostep peer host: .*new host" "$dir/$p.err"; then next=$p; fi
  done
  [ -n "$next" ] || fail "nobody says that it is the host"
}

living=$(seq 1 $last)
kill_host 0 "$players" 1 $living
if [ "$players" -ge 4 ]; then # of the three that are left two are a majority
  living=$(seq 1 $last | grep -vx "$next")
  kill_host "$next" "$last" 2 $living
fi

for p in $(printf '%s\n' $living | grep -vx "$next") "$next"; do # the host last: the others would seek another
  eval "interrupt 'peer $p' \$pid_$p"
  ! grep -q "DESYNC" "$dir/$p.err" || fail "peer $p tells of a desync"
done
for p in $living; do
  same_history "$next" "$p"
  "$tool" verify "$dir/$p.replay" || fail "the replay of peer $p does not verify"
done
