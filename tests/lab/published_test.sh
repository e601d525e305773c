#!/bin/sh
# isostep lab --published --short: its page has every test and needs nothing else, a peer stands in it, places are given,
# and what is kept is not run again.
# SPDX-License-Identifier: MIT
# usage: published_test.sh TOOL
set -u
tool=$1
. "$(dirname "$0")/../scratch.sh"
. "$(dirname "$0")/needs_nothing.sh"
out=$dir/lab

report() { "$tool" lab --published --short --out "$out" "$@" >"$dir/out" 2>"$dir/err"; }

# A peer's record in the file that the report reads: better than we are, or without a number.
mkdir "$out"
record() { # TEST HZ STATE FIGURE ENGINE
  printf '{"scene":"simbenchmark_%s","engine":"%s","scalar":"","solver":"","model":"rigid","hz":%s,"substeps":0,"state":"%s","reason":"","frames":600,"ms":0.05,"ms_mean":0.05,"penetration":0,"penetration_mean":0,"joint_error":0,"energy_gain":0,"energy_loss":0,"unrest":0,"signorini":null,"coulomb":null,"dissipation":null,"deviation":-1,"faults":0,"judged":true,"survived":false,"figure":%s,"outcome":[],"stood":true,"version":"x"}\n' \
    "$1" "$5" "$2" "$3" "$4"
}
{
  record 666 25 done 1e-9 better
  record bouncing 25 done null lost
} >"$out/published_peers.jsonl"
report || fail "lab --published --short failed"
page=$out/published.html
[ "$(cat "$dir/out")" = "$page" ] || fail "does not say where the page is"
for test in simbenchmark_rolling simbenchmark_666 simbenchmark_bouncing simbenchmark_anymal_momentum \
  simbenchmark_anymal_energy simbenchmark_anymal_pd erez_chain erez_humanoid erez_grasp predictable_stack; do
  [ "$(grep -c "<section id=\"$test\">" "$page")" -eq 1 ] || fail "no section of $test"
done
[ "$(tail -n 1 "$page")" = '</html>' ] || fail "the page does not end"
needs_nothing "$page"
grep -Eq '<p class="lead">isostep ran [0-9]+ comparisons, .* in [1-9][0-9]* of them in double' "$page" || fail "no place of ours on top"
grep -q '<section id="names">' "$page" || fail "nobody is named in full"
grep -q '<td>better</td>' "$page" || fail "the peer is not in the page"
grep -q 'its numbers are none' "$page" || fail "a peer without a number has one"
row() { grep "^| $1 .*$2" "$out/published.md"; }
row 666 '40 ms' | grep -q 'better 1.0e-09 *| 2, 2 ' || fail "a better peer does not take the first place"
row bouncing '40 ms' | grep -q 'RaiSim (2018) 12691 *| 1, 1 ' || fail "we are not the first where we are"
row 'ANYmal, flight' '10 ms' | grep -Eq '[0-9]e-[01][0-9] *\| MuJoCo' || fail "the articulation has no figure"
row 'chain, steps' '20 ms' | grep -q '| 0.0' || fail "runs of other steps are not compared"
row 'chain, steps' '1 ms' | grep -q . && fail "the run that others are compared with stands"
grep -q 'nan' "$out/published.md" "$page" && fail "something is no number"

before=$(cksum <"$out/results.jsonl")
report || fail "lab --published failed the second time"
[ "$(cksum <"$out/results.jsonl")" = "$before" ] || fail "runs were done again"
refuses() {
  words=$1
  shift
  "$tool" lab "$@" >"$dir/out" 2>"$dir/err"
  [ $? -eq 64 ] && grep -q -- "$words" "$dir/err" || fail "lab $* is not refused"
}
"$tool" lab --published --short --limit 0.001 --out "$dir/nothing" >"$dir/out" 2>"$dir/err" || fail "fails where all is left out"
grep -q '<p class="lead">No comparison: ' "$dir/nothing/published.html" || fail "counts comparisons that never were"
refuses "needs a directory" --published --out ''
echo "the published tests are whole"
