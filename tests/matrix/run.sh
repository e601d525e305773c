# What a built target must do: selfcheck, replay every recording, take states over. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT
#
# Each function here is a check of a loaded target. It leaves what it counted as variables; one that fails says why in
# `reason` and names the log in `log`.

# prove WORDS...: the target's prover, within its budget.
prove() { limited "$budget" sh -c "exec $prover \"\$@\"" sh "$@"; }

# why STATUS WHAT: the reason of a failure.
why() {
  case $1 in
    124) reason="$2 took longer than $budget s" ;;
    137) reason="$2 was killed: by the system, or because it did not end after $budget s" ;;
    *) reason="$2 exits $1" ;;
  esac
}

check_selfcheck() {
  log=$at/selfcheck.log
  prove selfcheck >"$log" 2>&1 || { why $? selfcheck; return 1; }
}

# plan: what the target is to replay, a line for each recording: how many frames (a number, or all), and its name.
plan() {
  for scalar in $scalars; do
    recorded=$(name_of "$scalar")
    case $floats,$scalar in
      short,float | short,double)
        rows short | while IFS=$tab read -r most scenes; do
          for scene in $scenes; do printf '%s %s\n' "$most" "$scene.$recorded"; done
        done
        ;;
      *) awk -v scalar="$recorded" '$2 == scalar {print "all " $1 "." $2}' "$goldens" ;;
    esac
  done
}

# expected_frames: of a plan, from the goldens.
expected_frames() {
  while read -r most name; do
    frames=$(frames_of "$name")
    if [ "$most" != all ] && [ "$most" -lt "$frames" ]; then frames=$most; fi
    echo "$frames"
  done | awk '{sum += $1} END {print sum + 0}'
}

# replay_part MOST: the recordings of the plan with so many frames, by one call of the prover.
replay_part() {
  wanted=$1
  set -- verify
  [ "$wanted" = all ] || set -- --frames "$wanted" verify
  while read -r most name; do
    [ "$most" != "$wanted" ] || set -- "$@" "$recordings/$name.replay"
  done <"$at/plan"
  prove "$@" >"$at/part.tsv" 2>>"$log"
}

# check_replays: every frame of the plan was compared and agreed. Leaves `replayed` and `compared`, their numbers.
check_replays() {
  log=$at/replay.log
  : >"$log"
  : >"$at/replay.tsv"
  plan >"$at/plan"
  worst=0
  for part in $(cut -d ' ' -f 1 "$at/plan" | sort -u); do
    replay_part "$part" || worst=$?
    tr -d '\r' <"$at/part.tsv" >>"$at/replay.tsv"
  done
  replayed=$(results VERIFIED | wc -l | tr -d ' ')
  compared=$(results '' | awk -F '\t' '{sum += $5} END {print sum + 0}')
  parted=$(results DIVERGED | wc -l | tr -d ' ')
  planned=$(wc -l <"$at/plan" | tr -d ' ')
  if [ "$parted" != 0 ]; then
    reason="$parted of $planned recordings diverge"
    return 1
  fi
  [ "$worst" = 0 ] || { why "$worst" replaying; return 1; }
  [ "$replayed" = "$planned" ] && [ "$compared" = "$(expected_frames <"$at/plan")" ] ||
    { reason="compared fewer frames than were recorded"; return 1; }
}

# results WORD: the lines of recordings whose result begins so.
results() { awk -F '\t' -v word="$1" '$1 != "total" && NF >= 7 && index($7, word) == 1' "$at/replay.tsv"; }

# take_over GOLDEN: its state goes from the reference to the target and on, and back.
take_over() {
  recording=$recordings/$1.replay
  middle=$(middle_of "$1")
  prove continue "$recording" "$middle" <"$recordings/$1.state" || return
  prove snapshot "$recording" "$middle" >"$at/state" || return
  limited "$budget" "$reference_prover" continue "$recordings/$1.replay" "$middle" <"$at/state"
}

# check_snapshots: of every scene that is for this. Leaves `taken`, how often a state was taken over.
check_snapshots() {
  log=$at/snapshots.log
  : >"$log"
  taken=0
  for scene in $snapshot_scenes; do
    for scalar in $scalars; do
      take_over "$scene.$(name_of "$scalar")" >>"$log" 2>&1 || { why $? "the snapshot of $scene, $scalar,"; return 1; }
      taken=$((taken + 2))
    done
  done
}

# show_divergence: what `diff` says of the first recording that does not come out, in divergence.txt.
show_divergence() {
  first=$(results DIVERGED | head -n 1)
  [ -n "$first" ] || return 1
  recording=${first%%"$tab"*}
  printf '%s: %s\n' "$recording" "${first##*"$tab"}" >"$at/divergence.txt"
  limited "$budget" "$reference_tool" diff --stages --prover-b "$prover" "$recording" >>"$at/divergence.txt" 2>&1
  return 0
}
