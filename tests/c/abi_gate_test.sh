#!/bin/sh
# The gate lets through what is the same or only more, and finds each change that breaks a program.
# usage: abi_gate_test.sh ABI.TXT
# SPDX-License-Identifier: MIT
set -u
. "$(dirname "$0")/../scratch.sh"
gate=$(dirname "$0")/abi_gate.sh
abi=$1
failures=0
let_through() { # name, file
  sh "$gate" "$abi" "$2" >"$dir/out" && return
  echo "abi gate: refuses $1: $(cat "$dir/out")" >&2
  failures=$((failures + 1))
}
found() { # name, what it says
  if cmp -s "$abi" "$dir/now"; then echo "abi gate: $1 changes nothing" >&2
  elif sh "$gate" "$abi" "$dir/now" >"$dir/out"; then echo "abi gate: lets $1 through" >&2
  elif ! grep -q "$2" "$dir/out"; then echo "abi gate: says of $1: $(cat "$dir/out")" >&2
  else return; fi
  failures=$((failures + 1))
}
size_of() { awk -v name="$1" '$2 == name && ($1 == "sized" || $1 == "plain") {print $3}' "$abi"; }
settings=iso_q32_settings
end=$(size_of $settings)

let_through "the same" "$abi"
{ cat "$abi"; echo "function iso_new iso_status(iso_world*)"; echo "enumerator ISO_SOLVER_NEW 4"; } >"$dir/now"
let_through "a new function and a new enumerator" "$dir/now"
sed "s/^sized $settings .*/sized $settings $((end + 8))/" "$abi" >"$dir/now"
echo "member $settings.new $end 8 number" >>"$dir/now"
let_through "a struct that grows at its end" "$dir/now"

# A member in the middle moves those behind it.
awk -v s="$settings." 'index($2, s) == 1 && $3 >= 16 {$3 += 8} {print}' "$abi" >"$dir/now"
echo "member $settings.new 16 8 u64" >>"$dir/now"
found "a member in the middle" "member $settings.gravity is"
{ cat "$abi"; echo "member $settings.new $((end - 4)) 4 u32"; } >"$dir/now"
found "a member in what was padding" "$settings.new is new at $((end - 4))"
{ cat "$abi"; echo "member iso_q32_material.new $(size_of iso_q32_material) 8 number"; } >"$dir/now"
found "a member of what others hold" "is new in a struct that others hold"
sed "s/^plain iso_q32_material .*/plain iso_q32_material 800/" "$abi" >"$dir/now"
found "another size of what others hold" "iso_q32_material has 800 bytes"
grep -v "^member $settings.hz " "$abi" >"$dir/now"
found "a member that is gone" "member $settings.hz is gone"
sed "s/^\(member $settings.hz [0-9]* [0-9]*\) i32/\1 u32/" "$abi" >"$dir/now"
found "another type of a member" "member $settings.hz is"
grep -v '^function iso_world_step ' "$abi" >"$dir/now"
found "a symbol that is gone" "function iso_world_step is gone"
sed 's/^function iso_world_step .*/function iso_world_step iso_status(iso_world*)/' "$abi" >"$dir/now"
found "another argument" "function iso_world_step is"
sed 's/^enumerator ISO_JOINT_TYPE_SLIDER .*/enumerator ISO_JOINT_TYPE_SLIDER 5/' "$abi" >"$dir/now"
found "an enumerator of another number" "enumerator ISO_JOINT_TYPE_SLIDER is"
sed "s/^sized $settings /plain $settings /" "$abi" >"$dir/now"
found "a struct without its size" "$settings is plain now"

[ "$failures" -eq 0 ] && echo "abi gate: finds what it should"
exit "$failures"
