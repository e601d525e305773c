# Long commands under a limit of time, and none of them left when the matrix is interrupted. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT

child=''

# limited SECONDS COMMAND...: its status, or 124 when it took longer. `timeout` leads a group of its own and passes a
# TERM on to all of it, so that one signal ends a build with its compilers. sh would give a command in the background
# an empty standard input: it keeps the caller's.
limited() {
  limit=$1
  shift
  { timeout -k 10 "$limit" "$@" <&3 3<&- & } 3<&0
  child=$!
  wait "$child"
  status=$?
  child=''
  return "$status"
}

end_child() {
  [ -z "$child" ] || kill -TERM "$child" 2>/dev/null
  [ -z "$child" ] || wait "$child" 2>/dev/null
}

# In a worker: ends with what it runs. Ctrl-C does not reach it, its parent does.
obey_signals() { trap 'end_child; exit 130' INT TERM HUP; }
