#!/bin/sh
# A program that was built with the last release's header runs with this one's library: what abi.txt says of it holds.
# usage: abi_gate.sh RELEASED.TXT NOW.TXT
# Functions and enumerators stay as they are. Structs that stand within others stay as they are. Structs that begin with
# their size keep their members and may grow: what is new lies behind the end that they had.
# SPDX-License-Identifier: MIT
set -u
awk '
  NR == FNR { # the release
    if ($1 == "sized" || $1 == "plain") {size[$2] = $3; sort_of[$2] = $1}
    else {key = $1 " " $2; $1 = $2 = ""; fact[key] = $0}
    next
  }
  {seen[$1 " " $2] = 1}
  $1 == "sized" || $1 == "plain" {
    if (!($2 in size)) next
    if (sort_of[$2] != $1) say($2 " is " $1 " now, and was " sort_of[$2])
    else if ($1 == "plain" && $3 != size[$2]) say($2 " has " $3 " bytes, and had " size[$2])
    else if ($1 == "sized" && $3 < size[$2]) say($2 " has shrunk to " $3 " bytes from " size[$2])
    next
  }
  {
    key = $1 " " $2; kind = $1; name = $2; offset = $3; $1 = $2 = ""
    if (key in fact) {
      if (fact[key] != $0) say(key " is" $0 ", and was" fact[key])
    } else if (kind == "member") {
      owner = name; sub("[.].*", "", owner)
      if (!(owner in size)) next
      if (sort_of[owner] == "plain") say(name " is new in a struct that others hold")
      else if (offset < size[owner]) say(name " is new at " offset ", and " owner " ended at " size[owner])
    }
  }
  function say(text) {print "abi: " text; findings++}
  END {
    for (key in fact) if (!(key in seen)) say(key " is gone")
    for (name in size) if (!((sort_of[name] " " name) in seen)) say(name " is gone, or another sort of struct")
    exit findings != 0
  }' "$1" "$2"
