# What every target replays, made by the reference build: a recording of each golden, and states from the middle of
# some. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT

snapshot_scenes='mixed S9 platform'

# The golden "mixed.q32.32" is of the scene "mixed" in the scalar "q32.32".
frames_of() { awk -v name="$1" '$1 "." $2 == name {print $3}' "$goldens"; }
scalar_of() {
  case $1 in
    *.q*) printf 'q%s\n' "${1##*.q}" ;;
    *) printf '%s\n' "${1##*.}" ;;
  esac
}
scene_of() { printf '%s\n' "${1%."$(scalar_of "$1")"}"; }
middle_of() { echo $(($(frames_of "$1") / 2)); }

# agrees GOLDEN: the hashes that the tool wrote have those of the golden, after every sixtieth frame and the last.
agrees() {
  awk -v name="$1" '
    FNR == NR {if ($1 "." $2 == name) {frames = $3; for (i = 5; i <= NF; ++i) golden[i - 4] = $i}; next}
    {++hashed; if (hashed % 60 == 0 || hashed == frames) {++marks; if ($2 != golden[marks]) {print "frame " $1 " differs"; bad = 1}}}
    END {exit bad || frames == 0 || hashed != frames}' "$goldens" "$recordings/$1.txt"
}

# record GOLDEN: from the empty world on; what the tool hashes must be the golden.
record() {
  limited 120 "$reference_tool" run "$(scene_of "$1")" --scalar "$(scalar_of "$1")" --frames "$(frames_of "$1")" \
    --record "$recordings/$1.replay" --hashes "$recordings/$1.txt" || return 1
  agrees "$1"
}

# record_state GOLDEN: what targets go on from.
record_state() {
  limited 120 "$reference_prover" snapshot "$recordings/$1.replay" "$(middle_of "$1")" >"$recordings/$1.state" &&
    [ -s "$recordings/$1.state" ]
}

# goldens_of SCENE: its goldens, of all scalars; without a scene, all.
goldens_of() { awk -v scene="${1:-}" 'scene == "" || $1 == scene {print $1 "." $2}' "$goldens"; }

refuse_recording() {
  cat "$recordings/log" >&2
  say "isostep: $1 cannot be recorded"
  return 1
}

# make_recordings: all of them, unless they are there and nothing that made them is newer.
make_recordings() {
  if [ -f "$recordings/.made" ] && [ -z "$(find "$reference_tool" "$reference_prover" "$goldens" \
    "$root/tests/matrix/recordings.sh" -newer "$recordings/.made" | head -n 1)" ]; then
    return 0
  fi
  say "recording every golden"
  rm -rf "$recordings"
  mkdir -p "$recordings" || return 1
  for name in $(goldens_of); do
    record "$name" >"$recordings/log" 2>&1 || refuse_recording "$name" || return 1
  done
  for scene in $snapshot_scenes; do
    for name in $(goldens_of "$scene"); do
      record_state "$name" 2>"$recordings/log" || refuse_recording "$name" || return 1
    done
  done
  : >"$recordings/.made"
}
