# What the tests of peers share: a host in the background.
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../scratch.sh"

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

# await WORDS NAME: until the peer NAME has said them.
await() { wait_until "$2 never says '$1'" grep -q -- "$1" "$dir/$2.err"; }

# wait_until ELSE COMMAND...: for a minute, for busy machines take long.
wait_until() {
  otherwise=$1
  shift
  tries=0
  until "$@"; do
    tries=$((tries + 1))
    [ "$tries" -lt 1200 ] || fail "$otherwise"
    sleep 0.05
  done
}
