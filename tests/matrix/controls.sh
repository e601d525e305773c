# Controls: builds that must be refused and must differ, and a recording that nothing can agree with. A check that
# cannot fail is no check. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT
#
# Inverted, a control is built with the project's own flags, or plays the recording as it was made: then it must be red.

# What a control that behaves is accused of.
tame='the guard lets it pass|it does not differ|the gate finds nothing|the flipped bit is not seen'

# guard_refuses: a user's file does not compile with the forced flags, and it is the guard that says so.
guard_refuses() {
  log=$at/refused.log
  extra=$forced
  [ -z "$inverted" ] || extra=''
  # shellcheck disable=SC2046,SC2086
  printf '#include "isostep/scalar/scalar.hpp"\n' >"$at/user.cpp"
  limited 60 "$(command_of_compiler)" -std=c++20 -fsyntax-only -I"$root/scalar/include" $(target_flags) $flags $extra \
    "$at/user.cpp" >"$log" 2>&1
  grep -q 'error.*isostep:' "$log"
}

# force_flags: after the project's own, hidden from the guard.
force_flags() {
  [ "$past" = - ] && past=''
  [ -z "$inverted" ] || return 0
  launcher="sh;$root/tests/matrix/append_flags.sh;$forced${past:+ $past}"
  if have ccache; then launcher="$launcher;ccache"; fi
  cmake_options="$cmake_options
-DCMAKE_CXX_COMPILER_LAUNCHER=$launcher"
}

# count_results PATTERN WORD: the recordings of scalars like that whose result begins so.
count_results() { results "$2" | awk -F '\t' -v pattern="$1" '$3 ~ pattern' | wc -l | tr -d ' '; }

# check_difference: floating scalars part from the recordings, fixed ones do not.
check_difference() {
  check_replays
  parted=$(count_results '^[fd]' DIVERGED)
  if [ "$parted" = 0 ]; then
    reason="it does not differ"
    return 1
  fi
  fixed=$(grep -c '\.q' "$at/plan")
  if [ "$(count_results '^q' VERIFIED)" != "$fixed" ]; then
    reason="fixed point differs"
    return 1
  fi
  verdict="differs, as it must: $parted of $(grep -vc '\.q' "$at/plan") recordings"
  [ "$fixed" = 0 ] || verdict="$verdict; fixed point agrees"
}

check_forced_build() {
  verdict=''
  [ "$past" = - ] || guard_refuses || fail_because "the guard lets it pass" "$log"
  force_flags
  build_or_fail || return 0
  check_difference || fail_because "$reason" "$log"
  [ "$gate" = - ] || check_gate_finds "$gate" || fail_because "$reason" "$log"
  [ -z "$past" ] || verdict="refused; forced, $verdict"
}

# check_flipped: one bit of the hash of one frame, in a recording whose checksums are right.
check_flipped() {
  flipped=$at/mixed.float.replay
  frame=$(($(frames_of mixed.float) - 2))
  cp "$recordings/mixed.float.replay" "$flipped"
  log=$at/flip.log
  [ -n "$inverted" ] || "$flip_program" "$recordings/mixed.float.replay" "$flipped" "$frame" 2>"$log" ||
    { why $? "flipping a bit"; fail_because "$reason" "$log"; return 0; }
  log=$at/replay.tsv
  program_of
  prove verify "$flipped" >"$log" 2>&1
  replayed=1 compared=$(awk -F '\t' 'NR == 1 {print $5}' "$log")
  grep -q "DIVERGED at frame $frame" "$log" || { fail_because "the flipped bit is not seen" "$log"; return 0; }
  verdict="seen, as it must: frame $frame of mixed in float"
}

# work_on_control NAME: its row is green when it behaves.
work_on_control() {
  load_control "$1"
  begin_target
  clock=$(date +%s)
  if [ "$forced" = - ]; then check_flipped; else check_forced_build; fi
  ran_in="$(($(date +%s) - clock)) s"
  [ "$forced" = - ] || flags="$flags $forced"
  finish_target "${result:+RED: }${result:-$verdict}"
}
