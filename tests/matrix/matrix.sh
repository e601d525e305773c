# isostep matrix: is every build of the library the same? Builds the prover for many targets and lets each replay what
# the reference build recorded. Sourced by ./isostep, whose functions it uses; README.md here tells the rest.
# SPDX-License-Identifier: MIT

tables=${ISOSTEP_MATRIX_TABLES:-$root/tests/matrix}
project=${ISOSTEP_MATRIX_PROJECT:-$root}
goldens=${ISOSTEP_MATRIX_GOLDENS:-$root/replays/goldens.txt}
matrix=${ISOSTEP_BUILD_DIR:-$root/build}/matrix
recordings=$matrix/recordings
all_scalars='float double Q16_16 Q32_32'
export WINEPREFIX="$matrix/wine" WINEDEBUG=-all  # the world of Windows programs, made when the first one runs
for part in children targets packages reference recordings build run gate target controls table; do
  . "$root/tests/matrix/$part.sh"
done

usage='usage: ./isostep matrix [--fast | --full] [--target NAME]... [--list] [--invert] [--markdown FILE]'
usage="$usage [--jobs N] [--within SECONDS]"
matrix_usage() { fail 64 "$1; $usage"; }

# most_at_once: targets, as many as there are processors and as there is memory for: compiling one takes up to 3 GB.
most_at_once() {
  [ -r /proc/meminfo ] || { jobs; return; }
  awk -v most="$(jobs)" '/^MemTotal:/ {room = int($2 / 3e6); if (room < most) most = room} END {print most < 1 ? 1 : most}' \
    /proc/meminfo
}

# deliver: standard input, to the caller; output that is lost is no success.
deliver() { cat 2>/dev/null || { say "isostep: standard output cannot be written${1:+: $1}"; return 74; }; }

# add_target NAME: to `chosen`, once. A name has no blanks and is no pattern, for the shell takes the list apart.
add_target() {
  case $1 in '' | *[!A-Za-z0-9+._-]*) no_target "$1" ;; esac
  case " $chosen " in *" $1 "*) ;; *) chosen="$chosen $1" ;; esac
}
no_target() { fail 64 "no target '$1': ./isostep matrix --list"; }

# read_words WORDS...: into set, chosen, listing, inverted, markdown, workers, within.
read_words() {
  set=fast chosen='' listing='' inverted='' markdown='' within='' workers=$(most_at_once)
  while [ $# -gt 0 ]; do
    case $1 in
      --fast) set=fast ;;
      --full) set=full ;;
      --list) listing=yes ;;
      --invert) inverted=yes ;;
      --help | -h) printf '%s\n' "$usage" | deliver; exit ;;
      --target | --markdown | --jobs | --within)
        [ $# -gt 1 ] || matrix_usage "$1 wants a word"
        case $1 in
          --target) add_target "$2" ;;
          --markdown)
            [ -n "$2" ] || matrix_usage "--markdown wants a file"
            case $2 in /*) markdown=$2 ;; *) markdown=$PWD/$2 ;; esac
            ;;
          --jobs)
            case $2 in '' | 0* | *[!0-9]* | ????*) matrix_usage "--jobs wants a number from 1 to 999" ;; esac
            workers=$2
            ;;
          --within)
            case $2 in '' | 0* | *[!0-9]* | ??????*) matrix_usage "--within wants a number from 1 to 99999" ;; esac
            within=$2
            ;;
        esac
        shift
        ;;
      *) matrix_usage "no option '$1'" ;;
    esac
    shift
  done
}

# choose: the names of targets and of controls that are to be worked on.
choose() {
  if [ -z "$chosen" ]; then
    column=5
    [ "$set" = fast ] || column=6
    targets=$(names_of targets "$column")
    controls=$(names_of controls)
  else
    targets='' controls=''
    for name in $chosen; do
      if row_of targets "$name" >/dev/null; then
        targets="$targets $name"
      elif row_of controls "$name" >/dev/null; then
        controls="$controls $name"
      else
        no_target "$name"
      fi
    done
  fi
  [ -z "$inverted" ] || targets=''
  [ -n "$targets$controls" ] || fail 64 "--invert is for controls"
}

# list_all: what can be named, and what --fast and --full do with it.
list_all() {
  {
    printf 'target\tmachine\tcompiler\tflags\tscalars of --fast\tof --full\toptions\n'
    rows targets
    rows controls | awk -F '\t' -v OFS='\t' '{print $1, $2, $3, $4 " " $7, $5, $6, "control"}'
  } | aligned
}

# run_all NAMES...: so many at once as there are workers, each of which takes the next one that nobody has.
run_all() {
  claims=$matrix/claims
  rm -rf "$claims"
  mkdir -p "$claims"
  build_jobs=$((workers / $#))
  [ "$build_jobs" -gt 0 ] || build_jobs=1
  crew='' hands=$workers
  [ "$hands" -le $# ] || hands=$#
  while [ "$(echo $crew | wc -w)" -lt "$hands" ]; do
    (
      obey_signals
      for name in $(in_turn "$@"); do
        if mkdir "$claims/$name" 2>/dev/null; then
          if no_time_for "$name"; then leave_out; else work_on "$name"; fi
        fi
      done
    ) &
    crew="$crew $!"
  done
  # shellcheck disable=SC2086
  wait $crew
}

# no_time_for NAME: --within is over, counted from the command's beginning, and it must be built. What has begun by then
# ends as it would. Loads it.
no_time_for() {
  load "$1"
  [ -n "$within" ] && [ "$compiler" != reference ] && [ "$(($(date +%s) - begun))" -ge "$within" ]
}
leave_out() {
  clear_target
  finish_target "not run here: $within s were over"
}

# in_turn NAMES...: what is emulated takes longest, so it comes first. With --within another one begins each day, so that
# who never has the time for all comes round. What is built already fills the end.
in_turn() {
  for name in "$@"; do
    load "$name"
    case $floats,$compiler in
      *,reference) echo "2 $name" ;;
      short,*) echo "0 $name" ;;
      *) echo "1 $name" ;;
    esac
  done | sort -s -k 1,1 | awk -v day="$(day)" '
    $1 == 2 {built = built $2 "\n"; next}
    {name[made++] = $2}
    END {for (i = 0; i < made; ++i) print name[(i + day) % made]; printf "%s", built}'
}
day() { [ -n "$within" ] && echo "${ISOSTEP_MATRIX_DAY:-$(($(date +%s) / 86400))}" || echo 0; }

load() { load_target "$1" || load_control "$1"; }
work_on() { if row_of targets "$1" >/dev/null; then work_on_target "$1"; else work_on_control "$1"; fi; }

# interrupt: Ctrl-C reaches this shell alone; what it started ends with it.
interrupt() {
  trap '' INT TERM HUP
  # shellcheck disable=SC2086
  [ -z "${crew:-}" ] || kill -TERM $crew 2>/dev/null
  end_child
  wait
  [ -z "${beside:-}" ] || rm -f "$beside"
  say "isostep: interrupted; the same command goes on with the builds as they are"
  exit 130
}

# rows_like PATTERN: of the rows on standard input how many have such a result.
rows_like() { awk -F '\t' -v pattern="$1" 'NR > 1 && $11 ~ pattern' | wc -l; }

# verdict NAMES...: 0 when every row is green, and those that were asked for by name ran; inverted controls must all be
# red because they behave, and that is never 0.
verdict() {
  if [ -n "$inverted" ]; then
    [ "$(all_rows "$@" | rows_like "^RED: ($tame)")" -eq $# ] ||
      { say "isostep: inverted, and a control is green or was not tried: it proves nothing"; return 2; }
    say "inverted: all $# controls are red, as they must be"
    return 1
  fi
  [ -z "$chosen" ] || [ "$(all_rows "$@" | rows_like 'not run here')" -eq 0 ] || return 1
  [ "$(all_rows "$@" | rows_like '^RED')" -eq 0 ]
}

matrix() {
  read_words "$@"
  choose
  if [ -n "$listing" ]; then list_all | deliver; exit; fi
  [ -z "$markdown" ] || takes_table || fail 74 "--markdown $markdown: $reason"
  cd "$root" || exit 70
  begun=$(date +%s)
  { true <&0; } 2>/dev/null || exec </dev/null  # what is started takes it over
  mkdir -p "$matrix" && touch "$matrix/.lock" || fail 70 "$matrix cannot be written"
  if have flock; then
    exec 8>"$matrix/.lock" && flock -w 10 8 || fail 70 "another matrix is at work in $matrix"
  fi
  make_reference
  # shellcheck disable=SC2086
  set -- $targets $controls
  trap interrupt INT TERM HUP
  bring_packages "$@"
  [ -z "$chosen" ] || [ -z "$(missing_of "$@")" ] || exit 69
  make_recordings || exit 70
  for name in "$@"; do rm -f "$matrix/$name/row"; done
  run_all "$@"
  print_table "$@" >"$matrix/table.txt" || fail 74 "$matrix/table.txt cannot be written"
  deliver "the table is in $matrix/table.txt" <"$matrix/table.txt"
  lost=$?
  if [ -n "$markdown" ]; then
    { print_markdown "$@" >"$matrix/table.md" && put_table; } || { lost=74; say "isostep: --markdown $markdown: $reason: the table is in $matrix/table.md"; }
  fi
  [ "$lost" = 0 ] || exit 74
  verdict "$@"
  exit
}
