#!/bin/sh
# The driver of the matrix from outside: what it refuses, what it calls green and red, and that nothing is left running.
# The targets are scripts (driver/), so that nothing is compiled.
# SPDX-License-Identifier: MIT
# usage: driver_test.sh REPOSITORY
set -u
root=$1
here=$root/tests/matrix/driver
top=$(mktemp -d) || exit 1
pid=''
trap '[ -z "$pid" ] || { kill "$pid"; wait "$pid"; }; rm -rf "$top"' EXIT
trap 'exit 130' INT TERM HUP
dir="$top/an owner's folder.q" # blanks, a quote and what a scalar's name begins with, in every path
mkdir -p "$dir/the repository/tests" && cp "$root/isostep" "$dir/the repository" &&
  cp -R "$root/cmake" "$dir/the repository" && cp -R "$root/tests/matrix" "$dir/the repository/tests" || exit 1
ln -s "$dir/the repository/isostep" "$dir/linked"
export PATH="$dir/programs:$PATH"
export ISOSTEP_NO_INSTALL=1 ISOSTEP_BUILD_DIR="$dir" ISOSTEP_MATRIX_REFERENCE="$dir/programs" \
  ISOSTEP_MATRIX_TABLES="$here" ISOSTEP_MATRIX_PROJECT="$here" ISOSTEP_MATRIX_GOLDENS="$dir/goldens.txt"

fail() {
  echo "$1" >&2
  cat "$dir/out" "$dir/err" >&2
  exit 1
}

# Three scenes of six frames in four scalars, and programs; the gate is given objdump, nm and one library.
mkdir -p "$dir/programs" || exit 1
for scene in mixed S9 platform; do
  for scalar in float double q16.16 q32.32; do
    printf '%s %s 6 digest f\n' "$scene" "$scalar" >>"$dir/goldens.txt"
  done
done
cp "$here/tool.sh" "$dir/programs/isostep"
cp "$here/prover.sh.in" "$dir/programs/isostep_prover"
printf '#!/bin/sh\ncp "$1" "$2" && echo flipped >>"$2"\n' >"$dir/programs/flip_hash"
printf '#!/bin/sh\n[ $# -eq 3 ] && [ -f "$3" ] && echo "all read"\n' >"$dir/programs/isostep_gate"
printf '#!/bin/sh\necho "all seen"\n' >"$dir/programs/gate_controls.sh"
printf '#!/bin/sh\necho "some-compiler 1"\n' >"$dir/programs/some-compiler"
chmod +x "$dir"/programs/*

# matrix STATUS WORDS...
matrix() {
  wanted=$1
  shift
  "$dir/linked" matrix "$@" >"$dir/out" 2>"$dir/err"
  status=$?
  [ "$status" -eq "$wanted" ] || fail "matrix $* exits $status, not $wanted"
}
says() { grep -Eq -- "$1" "$dir/out" || fail "no line '$1'"; }
warns() { grep -Eq -- "$1" "$dir/err" || fail "no warning '$1'"; }

# Words.
matrix 64 --slow && warns "no option '--slow'; usage: "
matrix 64 --target && warns "wants a word"
for number in many '' 0 99999999999999999999; do matrix 64 --jobs "$number" && warns "wants a number"; done
for number in soon '' 0; do matrix 64 --within "$number" && warns "wants a number"; done
for name in nowhere '' ' ' '*' 'good emulated'; do
  matrix 64 --target "$name" && warns "no target '.*'" && [ "$(wc -l <"$dir/err")" -eq 1 ] || fail "more than one line"
done
matrix 64 --target good --markdown '' && warns 'wants a file'
matrix 0 --help && says '^usage: ./isostep matrix '
matrix 64 --target good --invert && warns '--invert is for controls'
matrix 0 --list && says '^diverges +here ' && says '^flipped-bit '
[ ! -d "$dir/matrix" ] || fail "--list makes something"
if [ -c /dev/full ]; then
  for word in --list --help; do
    "$root/isostep" matrix "$word" >/dev/full 2>"$dir/err"
    [ $? -eq 74 ] && warns 'standard output cannot be written' || fail "$word that nobody gets is a success"
  done
fi

# Green: 6 recordings of 6 frames in two scalars, each state taken over both ways; short: 2 + 4 + 4 frames in a scalar.
matrix 0 --target good --target emulated --markdown "$dir/table.md"
says '^good +[^ ]+ +-O1 +float q16.16 +6 +36 +12 +clean .* green$'
says '^emulated .* all +12 +56 +24 +clean .* green$'
says '^2 green, 0 red, 0 not run here: 18 recordings, 92 frames, 36 snapshots'
warns '^good: begins$' && warns '^good: green$'
grep -q '^| good |.*| green |$' "$dir/table.md" || fail "no row in Markdown"
printf 'above\n<!-- matrix -->\nold\n<!-- /matrix -->\nbelow\n' >"$dir/page.md"
matrix 0 --target good --markdown "$dir/page.md"
[ "$(grep -Ec '^(above|below|old)$|^\| good ' "$dir/page.md")" -eq 3 ] && ! grep -q '^old$' "$dir/page.md" ||
  fail "the table is not between its marks"
[ "$(head -n 2 "$dir/page.md" | tr '\n' ,)$(tail -n 2 "$dir/page.md" | tr '\n' ,)" = \
  'above,<!-- matrix -->,<!-- /matrix -->,below,' ] || fail "the marks are not where they were"

# A table goes where nothing is lost by it, and that is known before the work begins.
echo mine >"$dir/mine.md"
rm -r "$dir/matrix"
matrix 74 --target good --markdown "$dir/mine.md" && warns 'it has text, and not one '
for marks in 'above\n<!-- matrix -->\nbelow\n' 'above\n<!-- /matrix -->\nbelow\n' \
  'above\n<!-- /matrix -->\nbetween\n<!-- matrix -->\nbelow\n' \
  '<!-- matrix -->\n<!-- /matrix -->\nbetween\n<!-- matrix -->\n<!-- /matrix -->\n'; do
  # shellcheck disable=SC2059
  printf "$marks" | tee "$dir/before.md" >"$dir/marks.md"
  matrix 74 --target good --markdown "$dir/marks.md" && cmp -s "$dir/before.md" "$dir/marks.md" ||
    fail "text is lost where marks are not a pair"
done
matrix 74 --target good --markdown "$dir" && matrix 74 --target good --markdown /proc/table.md
matrix 74 --target good --markdown "$dir/nowhere/table.md"
[ "$(cat "$dir/mine.md")" = mine ] || fail "a file without marks is overwritten"
[ ! -d "$dir/matrix" ] || fail "the work begins before the table is known to have a place"
ln -s linked.md "$dir/link.md"
(cd "$dir" && ISOSTEP_BUILD_DIR=beside && matrix 0 --target good --target good --markdown link.md) || exit 1
[ -L "$dir/link.md" ] && grep -q '^| good ' "$dir/linked.md" || fail "the table is not where the caller is"
says '^1 green, 0 red, 0 not run here: 6 recordings,'
[ -d "$dir/beside/matrix/good" ] && [ ! -e "$root/beside" ] || fail "the builds are not where the caller is"
if [ -c /dev/full ]; then
  "$root/isostep" matrix --target good >/dev/full 2>"$dir/err"
  [ $? -eq 74 ] && warns 'the table is in .*/table\.txt$' && grep -q '^good .* green$' "$dir/matrix/table.txt" ||
    fail "a table that nobody gets is a success"
fi

# An old build stands while what made it does.
matrix 0 --target emulated
: >"$dir/matrix/emulated/build/made before"
matrix 0 --target emulated
[ -f "$dir/matrix/emulated/build/made before" ] && says '^emulated .* kept ' || fail "what is built is built again"
printf '#!/bin/sh\necho "some-compiler 2"\n' >"$dir/programs/some-compiler"
matrix 0 --target emulated && says '^emulated .*some-compiler 2 .* [0-9]* s  *[0-9]* s '
[ ! -f "$dir/matrix/emulated/build/made before" ] || fail "a newer compiler is proved by an old one's build"

# Red, each for its own reason; what is green beside stays green.
matrix 1 --fast --jobs 3
says '^good .* green$'
says '^diverges .* RED: 3 of 6 recordings diverge$'
says '^    frame 3, stage solve_substeps, bodies\[1\]\.velocity\.x$'
says '^unbuildable .* RED: it cannot be built$' && says "  unbuildable: .*/unbuildable/build\.log"
says '^skips .* RED: compared fewer frames than were recorded$'
says '^hangs .* RED: .*replaying took longer than 1 s'  # if not selfcheck too, where the machine is busy
says '^far .* RED: needs compiler-for-far$' && warns 'install -y --no-install-recommends compiler-for-far$'
says '^tomorrow .* - .* not run here: this CPU has no avx4096$'
says '^flipped-bit .* seen, as it must: frame 4 of mixed in float$'
grep -q '^flipped-bit.*SIMD' "$dir/out" && fail "the reference build is shown with options it does not have"
matrix 69 --target far
matrix 1 --target tomorrow

# No time: what has not begun and must be built is left out, and is not green where it was asked for. `hangs` begins on
# day 4.
ISOSTEP_MATRIX_DAY=4 matrix 1 --target hangs --target good --target flipped-bit --jobs 1 --within 1
says '^good .* - .* not run here: 1 s were over$' && says '^flipped-bit .* seen, as it must: '
# Another one begins each day.
for day in 4,hangs 5,good; do
  ISOSTEP_MATRIX_DAY=${day%,*} matrix 1 --target hangs --target good --jobs 1 --within 3600
  [ "$(grep -m 1 ': begins' "$dir/err")" = "${day#*,}: begins" ] || fail "day ${day%,*} does not begin with ${day#*,}"
done

# A gate that finds something; a control that is none any more.
printf '#!/bin/sh\necho "1 fused"\nexit 1\n' >"$dir/programs/isostep_gate"
matrix 1 --target good && says '^good .* RED +.* RED: the gate: 1 fused$'
matrix 1 --invert && warns 'all 1 controls are red' && says 'RED: the flipped bit is not seen'

printf '#!/bin/sh\nexit 74\n' >"$dir/programs/flip_hash"
matrix 1 --target flipped-bit && says 'RED: flipping a bit exits 74$'

# A recording that is not the golden stops everything.
sed -i 's/5 f/5 x/' "$dir/programs/isostep"
matrix 70 --target good && warns 'cannot be recorded'
cp -f "$here/tool.sh" "$dir/programs/isostep"

# Interrupted: it says so, and what it started is gone.
rm -f "$dir/sleeper"
"$root/isostep" matrix --full --target patient >"$dir/out" 2>"$dir/err" &
pid=$!
while [ ! -s "$dir/sleeper" ] && kill -0 "$pid" 2>/dev/null; do sleep 0.2; done # ctest has the limit: machines are busy
[ -s "$dir/sleeper" ] || fail "the patient one did not start"
kill -TERM "$pid"
wait "$pid"
status=$?
pid=''
[ "$status" -eq 130 ] || fail "interrupted, it does not exit 130"
warns 'interrupted; the same command goes on'
kill -0 "$(cat "$dir/sleeper")" 2>/dev/null && fail "interrupted, it leaves a child"

# The tables of the repository: every scene is played where floats are emulated.
for scene in $(awk '$2 == "float" {print $1}' "$root/replays/goldens.txt"); do
  grep -qw "$scene" "$root/tests/matrix/short.tsv" || fail "short.tsv leaves out $scene"
done

[ "$(sh "$root/tests/matrix/append_flags.sh" '-b -c' echo -a)" = '-a -b -c' ] || fail "flags are not appended"
echo "the matrix is green, red and refused where it should be"
