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
  tries=0
  while [ ! -s "$dir/port" ]; do
    tries=$((tries + 1))
    [ "$tries" -lt 1200 ] || fail "the host wrote no port"
    sleep 0.05
  done
  port=$(cat "$dir/port")
}

# await WORDS NAME: until the peer NAME has said them; busy machines take long.
await() {
  tries=0
  until grep -q -- "$1" "$dir/$2.err"; do
    tries=$((tries + 1))
    [ "$tries" -lt 1200 ] || fail "$2 never says '$1'"
    sleep 0.05
  done
}
