#!/bin/sh
# isostep lab from outside: its table, JSON and CSV; going on after an interruption and after a crash; refusals.
# SPDX-License-Identifier: MIT
# usage: command_test.sh TOOL
set -u
tool=$1
. "$(dirname "$0")/../scratch.sh"
out=$dir/lab

lab() { "$tool" lab "$@" >"$dir/out" 2>"$dir/err"; }
small() { lab S1x5 --scalars double,q32.32 --solvers soft_step,pgs --substeps 2,8 --frames 60 --out "$out" "$@"; }
lines() { wc -l <"$out/results.jsonl" | tr -d ' '; }

# A table with its advice.
small --csv "$dir/runs.csv" || fail "lab S1x5 failed"
grep -q '^S1x5, tolerance 10mm, deviation after 1 s from double, soft_step, 64 sub-steps at 60 Hz$' "$dir/out" ||
  fail "no headline"
grep -q '^no spheres: ' "$dir/out" || fail "no word of the models that cannot be"
grep -Eq '^\* +[0-9.e-]+ +(double|q32\.32) ' "$dir/out" || fail "no row is marked"
grep -Eq '^advice: (double|q32\.32), .* at 60 Hz: [0-9.e-]+ ms; (the default|that is)' "$dir/out" || fail "no advice"
[ "$(lines)" = 8 ] || fail "expected 8 results"
[ "$(wc -l <"$dir/runs.csv")" -eq 9 ] || fail "expected a header and 8 rows"

# Progress is no part of what is printed.
grep -q '^8 of 8 runs, about 0 s left: S1x5 ' "$dir/err" || fail "no word of how far it is"
grep -q ' of 8 runs' "$dir/out" && fail "progress is in the table"
lab springs --quick --json || fail "lab springs failed"
[ "$(head -n 1 "$dir/out")" = '{' ] && [ "$(tail -n 1 "$dir/out")" = '}' ] || fail "springs print more than JSON"
grep -Eq '^([0-9]+) of \1 runs, about 0 s left: net ' "$dir/err" || fail "springs do not say how far they are"

# What is done is not done again, and the JSON is of the same runs.
before=$(cksum <"$out/results.jsonl")
small --json || fail "lab --json failed"
grep -q '"advice_by_scalar"' "$dir/out" || fail "no advice for each scalar"
[ "$(cksum <"$out/results.jsonl")" = "$before" ] || fail "runs were done again"

# A line cut by a crash is run again, nothing else.
head -c -30 "$out/results.jsonl" >"$dir/cut" && cp "$dir/cut" "$out/results.jsonl"
small || fail "lab failed after a cut"
[ "$(lines)" = 8 ] || fail "expected 8 results after a cut"

# A list ends where its commas end, and a scene's file is a scene; nothing is kept when that is asked.
(cd "$dir" && "$tool" scenes --write scenes >/dev/null) || fail "scenes --write failed"
lab --substeps 4 --scalars double --solvers pgs --frames 10 --out "" "$dir/scenes/S1x5.json" || fail "lab of a file failed"
grep -q '^advice: double, ' "$dir/out" || fail "no advice for a scene's file"

# A run that would be too long never begins, on any machine, and is not kept: 600 steps of 6 bodies with 8 sub-steps and
# what a step has beside are 43 200, of pgs with 2 passes 21 600.
lab S1x5 --scalars double --solvers soft_step,pgs --substeps 2,8 --frames 600 --limit 0.03 --out "$dir/short" --csv "$dir/short.csv" ||
  fail "lab --limit failed"
[ "$(grep -c ',8,left_out,too long: 0.0432 million body sub-steps,0,' "$dir/short.csv")" -eq 2 ] ||
  fail "long runs are not left out"
[ "$(grep -c ',2,done,' "$dir/short.csv")" -eq 2 ] || fail "others are left out"
[ "$(wc -l <"$dir/short/results.jsonl")" -eq 2 ] || fail "runs that never began are kept"

# Where nothing ran nothing is advised, and what was refused has no figures.
lab S1x5 --scalars double --solvers pgs --substeps 2 --limit 0.001 --out "" || fail "lab fails where nothing runs"
grep -q '^advice: none, for nothing was run: too long: ' "$dir/out" || fail "advice of runs that never were"
lab S13 --scalars q16.16 --solvers pgs --substeps 2 --frames 1 --out "" || fail "lab fails where a scalar is refused"
grep -q 'inf' "$dir/out" && fail "a refused run has figures"

# Ctrl-C ends with whole lines and says how to go on. The run is too long to end by itself.
rm -rf "$out"
"$tool" lab S1x5 --scalars double --solvers soft_step --substeps 8 --frames 100000000 --limit 1e6 --out "$out" \
  >"$dir/out" 2>"$dir/err" &
lab=$!
until [ -e "$out/results.jsonl" ] || ! kill -0 "$lab" 2>/dev/null; do sleep 0.1; done # it listens from then on
grep -q . "$out/results.jsonl" && fail "a run that had no time ended"
lab S1x5 --out "$out"
[ $? -eq 74 ] && grep -q 'another isostep lab writes there' "$dir/err" || fail "two write into one file"
kill -INT "$lab"
wait "$lab"
[ $? -eq 130 ] || fail "an interrupted lab exits with another status than 130"
grep -q 'interrupted with 0 of 1 runs done, kept in .*: the same command goes on from there' "$dir/err" ||
  fail "no word of how to go on"

# refuses STATUS WORDS ARGUMENTS...
refuses() {
  wanted=$1 words=$2
  shift 2
  lab "$@" --out "$out"
  status=$?
  [ "$status" -eq "$wanted" ] && grep -q -- "$words" "$dir/err" && [ "$(wc -l <"$dir/err")" -eq 1 ] &&
    [ ! -s "$dir/out" ] || fail "lab $* exits $status"
}
refuses 64 "a scene is missing"
refuses 64 "no scene is named" nowhere
refuses 66 "none.json" "$dir/none.json"
refuses 64 "character 8: expected a unit" S1x5 --tolerance joint=1kg
refuses 64 'no scalar is named "half"' S1x5 --scalars half
refuses 64 'no solver is named "magic"' S1x5 --solvers magic
refuses 64 "S1x5 has no spheres: as spheres" S1x5 --models spheres
refuses 64 "of particles already" rope
refuses 64 "substeps" S1x5 --substeps 65
refuses 64 "hz" S1x5 --hz 5
refuses 74 "" S1x5 --csv "$dir/none/a.csv"
refuses 64 "S1x5 is no trial" S1x5 --tolerance figure=1
refuses 64 "are for --all and --published" S1x5 --short
refuses 64 "are for --all and --published" S1x5 --peers true
refuses 64 "--full requires --published" S1x5 --full
refuses 64 "scene excludes --all" S1x5 --all
refuses 64 "excludes" --all --scalars double
refuses 64 "excludes" --published --csv "$dir/a.csv"
refuses 64 "excludes" --published --all
refuses 64 "excludes" --published --short --full
refuses 66 "no such program" --published --short --peers "$dir/none"
echo '{"bodies": [{"type": "dynamic"}]}' >"$dir/wrong.json"
refuses 64 "wrong.json:/bodies/0" "$dir/wrong.json"
mkdir -p "$out" && echo '{}' >"$out/results.jsonl"
refuses 64 "results.jsonl:1: scene is missing; without that line its run is done again" S1x5 --frames 1
echo "the laboratory answers, goes on, and refuses"
