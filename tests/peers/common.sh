# What the tests of peers share: a host in the background, waiting for what peers say, and comparing what they saw.
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../scratch.sh"

patient='--patience 600'           # seconds: on a machine that stalls nobody has left
endless="$patient --frames 1000000" # until it is interrupted

# start_host NAME WORDS...: sets `host` to its process and `port` to the port that it was given.
start_host() {
  name=$1
  shift
  rm -f "$dir/port"
  "$tool" peer --listen 0 --port-file "$dir/port" "$@" >"$dir/$name.out" 2>"$dir/$name.err" &
  host=$!
  wait_until "the host wrote no port" test -s "$dir/port"
  port=$(cat "$dir/port")
}

# await WORDS NAME [TIMES]: until the peer NAME has said them so often.
await() { wait_until "$2 never says '$1' ${3:-1} times" said "$1" "$2" "${3:-1}"; }
said() { [ "$(grep -c -- "$1" "$dir/$2.err")" -ge "$3" ]; }

# wait_until ELSE COMMAND...: for ten minutes, for busy machines take long; not when the host has ended.
wait_until() {
  otherwise=$1
  shift
  tries=0
  until "$@"; do
    tries=$((tries + 1))
    [ "$tries" -lt 6000 ] && ! has_ended "$host" || fail "$otherwise"
    sleep 0.1
  done
}

# A process that nobody waited for yet, where the system tells.
has_ended() { [ -r "/proc/$1/status" ] && grep -q '^State:[[:blank:]]*Z' "/proc/$1/status"; }

# interrupt NAME PROCESS: ends a peer that plays until then; its files are whole.
interrupt() {
  kill -INT "$2"
  wait "$2"
  status=$?
  [ "$status" -eq 130 ] || fail "interrupted, $1 exits with $status"
}

# same_history HOST PEER: their hashes agree in every frame that both have, and there is one. Interrupted at different
# times, either may have frames that the other lacks.
same_history() {
  awk 'NR == FNR { hash[$1] = $2; next }
       $1 in hash { ++both; if (hash[$1] != $2) differ = 1 }
       END { exit differ || !both }' "$dir/$1.txt" "$dir/$2.txt" || fail "$2 saw another match than $1"
}
