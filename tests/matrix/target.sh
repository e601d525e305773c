# One target from its packages to its row. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT

# clear_target: nothing of an earlier run is taken for this one's.
clear_target() {
  mkdir -p "$at"
  rm -f "$at/row" "$at/because" "$at/divergence.txt" "$at/replay.tsv"
  result='' replayed=- compared=- taken=- gated=- built_in=- ran_in=-
}
begin_target() {
  clear_target
  say "$target: begins"
}

# fail_because REASON LOG: red; what can still be checked is.
fail_because() {
  result="${result:+$result; }$1"
  [ -z "$2" ] || printf '  %s: %s: %s\n' "$target" "$1" "$2" >>"$at/because"
}

# build_or_fail: once what it needs is there.
build_or_fail() {
  began=$(date +%s)
  : >"$at/.began"
  lacking=$(missing_of "$target")
  if [ -n "$lacking" ]; then
    fail_because "needs ${lacking% }" ''
    return 1
  fi
  if [ "$compiler" != reference ]; then
    build_target || { fail_because "it cannot be built" "$log"; return 1; }
    built_in="$(($(date +%s) - began)) s"
  fi
  program_of || { fail_because "it has no prover" "$at/build"; return 1; }
  [ "$built_in" = - ] || [ -n "$(find "$program" -newer "$at/.began")" ] || built_in=kept
}

run_checks() {
  began=$(date +%s)
  check_selfcheck || fail_because "$reason" "$log"
  if ! check_replays; then
    fail_because "$reason" "$log"
    show_divergence && sed 's/^/    /' "$at/divergence.txt" >>"$at/because"
  fi
  check_snapshots || fail_because "$reason" "$log"
  ran_in="$(($(date +%s) - began)) s"
}

# run_gate: the rows of --simd are one build, which the row of all lanes looks at.
run_gate() {
  [ -z "$simd" ] || return 0
  if check_gate; then
    gated=clean
  else
    gated=RED
    fail_because "$reason" "$log"
  fi
}

# shown_flags: those of the toolchain, of the target, and its options.
shown_flags() {
  shown=$flags
  for word in $options; do
    case $word in
      -D*) shown="$shown ${word#-D}" ;;
      simd:*) shown="$shown --simd $simd" ;;
    esac
  done
  echo $(toolchain_flags) "$shown"
}

shown_scalars() {
  if [ "$scalars" = "$all_scalars" ]; then echo all; return; fi
  for scalar in $scalars; do name_of "$scalar"; done | paste -s -d ' ' -
}

# finish_target RESULT
finish_target() {
  write_row "$target" "$(name_of_compiler)" "$(shown_flags)" "$(shown_scalars)" "$replayed" "$compared" "$taken" \
    "$gated" "$built_in" "$ran_in" "$1"
  say "$target: $1"
}

# work_on_target NAME: whatever happens, it leaves a row.
work_on_target() {
  load_target "$1"
  begin_target
  green=green
  if build_or_fail; then
    run_gate
    if cpu_can; then run_checks; else green="not run here: this CPU has no $cpu"; fi
  fi
  finish_target "${result:+RED: }${result:-$green}"
}
