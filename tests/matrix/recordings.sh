# What every target replays, made by the reference build: a recording of each golden list, and states from the middle of
# some. Sourced by matrix.sh.
# SPDX-License-Identifier: MIT

snapshot_scenes='mixed S9 platform'

# The golden list "mixed.q32.32" is of the scene "mixed" in the scalar "q32.32".
frames_of() { wc -l <"$goldens/$1.txt" | tr -d ' '; }
scalar_of() {
  case $1 in
    *.q*) printf 'q%s\n' "${1##*.q}" ;;
    *) printf '%s\n' "${1##*.}" ;;
  esac
}
scene_of() { printf '%s\n' "${1%."$(scalar_of "$1")"}"; }
middle_of() { echo $(($(frames_of "$1") / 2)); }

# record LIST: from the empty world on; the hashes that the tool writes beside must be the list.
record() {
  limited 120 "$reference_tool" run "$(scene_of "$1")" --scalar "$(scalar_of "$1")" --frames "$(frames_of "$1")" \
    --record "$recordings/$1.replay" --hashes "$recordings/$1.txt" || return 1
  cmp "$recordings/$1.txt" "$goldens/$1.txt"
}

# record_state LIST: what targets go on from.
record_state() {
  limited 120 "$reference_prover" snapshot "$recordings/$1.replay" "$(middle_of "$1")" >"$recordings/$1.state" &&
    [ -s "$recordings/$1.state" ]
}

# lists_of SCENE: its golden lists, of all scalars.
lists_of() { (cd "$goldens" && ls "$1".*.txt | sed 's/\.txt$//'); }

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
  say "recording every golden list"
  rm -rf "$recordings"
  mkdir -p "$recordings" || return 1
  for list in "$goldens"/*.txt; do
    name=$(basename "$list" .txt)
    record "$name" >"$recordings/log" 2>&1 || refuse_recording "$name" || return 1
  done
  for scene in $snapshot_scenes; do
    for name in $(lists_of "$scene"); do
      record_state "$name" 2>"$recordings/log" || refuse_recording "$name" || return 1
    done
  done
  : >"$recordings/.made"
}
