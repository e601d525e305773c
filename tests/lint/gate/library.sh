#!/bin/sh
# library.sh GATE OBJDUMP NM AR LD ARCHIVES...: the gate over the members of static libraries, in a fiftieth of the time.
# SPDX-License-Identifier: MIT
#
# A template's instance has a section to itself, so thousands of functions begin at address 0 of an object, and objdump
# looks among all of them for the name of every jump's target. A relocatable link puts a member's code into one section
# first and changes no instruction. Each member alone: what two of them share is seen in both. What cannot be taken
# apart so (another linker, members of one name) is read as it is.
set -u
[ "$#" -ge 6 ] || { echo "usage: library.sh GATE OBJDUMP NM AR LD ARCHIVES..." >&2; exit 64; }
gate=$1 objdump=$2 nm=$3 ar=$4 ld=$5
shift 5
dir=$(mktemp -d) || exit 70
trap 'rm -rf "$dir"' EXIT
trap 'exit 130' INT TERM HUP
echo 'SECTIONS { .text : { *(.text .text.*) } }' >"$dir/one_section"

# take_apart ARCHIVE FOLDER: its members there, one section each. All or none.
take_apart() {
  mkdir "$2" && "$ar" t "$1" >"$2.names" && (
    cd "$2" || exit 1
    count=0
    while read -r member; do  # several may have one name
      count=$((count + 1))
      "$ar" xN "$(head -n "$count" "$2.names" | grep -Fcx -- "$member")" "$1" "$member" &&
        "$ld" -r --force-group-allocation -T "$dir/one_section" "$member" -o "$count.$member" && rm "$member" || exit 1
      "$objdump" -h "$count.$member" | awk '$2 == ".text" && $3 ~ /[1-9a-f]/ {found = 1} END {exit !found}' ||
        rm "$count.$member"  # data alone
    done <"$2.names"
  ) 2>"$dir/said"
}

archives=$#
for archive in "$@"; do
  case $archive in /*) ;; *) archive=$PWD/$archive ;; esac
  folder=$dir/$(($# - archives)).$(basename "$archive")
  if take_apart "$archive" "$folder"; then
    set -- "$@" "$folder"/*
  else
    set -- "$@" "$archive"
  fi
done
shift "$archives"
"$gate" "$objdump" "$nm" "$@"
