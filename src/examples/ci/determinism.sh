#!/bin/sh
# What every job of the continuous integration runs, and what compares the jobs: to be copied into a game's repository.
# SPDX-License-Identifier: MIT
#
# determinism.sh selfcheck GAME                    does the engine compute here as it does everywhere?
# determinism.sh hashes GAME FRAMES FILE           writes the hash of every frame
# determinism.sh goldens FILE GOLDEN               are these the hashes that the repository has?
# determinism.sh compare FOLDER                    are all *.hashes below FOLDER alike? Two at least
# Exits 0; 1 where something differs, and says which frame; 64 on other words; 66 where a file is missing.
set -u
fail() { status=$1; shift; echo "determinism: $*" >&2; exit "$status"; }

# first_difference A B: "line 17: float 16 0123... | float 16 4567..."; nothing where both are alike.
first_difference() {
  awk -v other="$2" '{
      if ((getline line < other) <= 0) line = "nothing"
      if (line != $0) {print "line " NR ": " $0 " | " line; found = 1; exit}
    }
    END {if (!found && (getline line < other) > 0) print "line " NR + 1 ": nothing | " line}' "$1"
}

# same A B: or both are named with the first line that differs.
same() {
  [ -s "$1" ] || fail 66 "$1 is missing or empty"
  [ -s "$2" ] || fail 66 "$2 is missing or empty"
  difference=$(first_difference "$1" "$2")
  [ -z "$difference" ] || fail 1 "$1 and $2 differ: $difference"
}

case ${1:-},$# in
  selfcheck,2) exec "$2" selfcheck ;;
  hashes,4)
    "$2" hashes "$3" >"$4" || fail $? "$2 hashes $3 ended with $?"
    [ -s "$4" ] || fail 66 "$2 hashes $3 printed nothing"
    ;;
  goldens,3)
    same "$2" "$3"
    echo "$(wc -l <"$2") hashes are those of $3"
    ;;
  compare,2)
    files=$(find "$2" -name '*.hashes' | sort)
    [ "$(printf '%s\n' "$files" | grep -c .)" -ge 2 ] || fail 66 "fewer than two *.hashes below $2: nothing is compared"
    first=''
    # shellcheck disable=SC2086
    for file in $files; do  # a name with a blank is taken apart and missing, which fails
      first=${first:-$file}
      same "$first" "$file"
    done
    echo "$(printf '%s\n' "$files" | wc -l) machines agree on $(wc -l <"$first") hashes"
    ;;
  *) fail 64 "usage: determinism.sh selfcheck GAME | hashes GAME FRAMES FILE | goldens FILE GOLDEN | compare FOLDER" ;;
esac
