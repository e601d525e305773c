#!/bin/sh
# isostep lab --all --short: its page has every section and nothing unfinished, its lines are JSON, and what is kept is
# written again byte for byte.
# SPDX-License-Identifier: MIT
# usage: report_test.sh TOOL
set -u
tool=$1
. "$(dirname "$0")/../scratch.sh"
. "$(dirname "$0")/needs_nothing.sh"
out=$dir/lab

report() { "$tool" lab --all --short --out "$out" "$@" >"$dir/out" 2>"$dir/err"; }

# A peer's program of our own: it is called with where its lines go.
cat >"$dir/peers" <<'PEERS'
#!/bin/sh
[ "$1" = --out ] || exit 64
cat >>"$2" <<LINE
{"scene":"S6v","engine":"ode","scalar":"","solver":"","model":"rigid","hz":60,"substeps":0,"state":"done","reason":"","frames":600,"ms":0.05,"ms_mean":0.05,"penetration":0,"penetration_mean":0,"joint_error":0.2,"energy_gain":0,"energy_loss":0,"unrest":0,"signorini":null,"coulomb":null,"dissipation":null,"deviation":-1,"faults":0,"judged":false,"survived":false,"figure":2.5,"outcome":[],"stood":true,"version":"x"}
LINE
PEERS
chmod +x "$dir/peers"
report --peers "$dir/peers" || fail "lab --all --short failed"
page=$out/report.html
[ "$(cat "$dir/out")" = "$page" ] || fail "does not say where the page is"
for section in games names advice accuracy survival growth springs stages; do
  [ "$(grep -c "<section id=\"$section\">" "$page")" -eq 1 ] || fail "no section $section"
done
[ "$(tail -n 1 "$page")" = '</html>' ] || fail "the page does not end"
grep -Eq '\{\{|\}\}|%s|nan|TODO' "$page" && fail "something in the page is unfinished"
needs_nothing "$page"
grep -q 'ode: 0.05 ms' "$page" || fail "the peer is not in the page"
grep -q '<p class="lead">Begin with soft_step and 8 sub-steps' "$page" || fail "no advice on top"
grep -q 'ODE 0.16 (Debian)' "$page" || fail "the peer is not named in full"
if command -v gnuplot >/dev/null 2>&1; then
  [ "$(grep -c '<svg' "$page")" -eq 4 ] || fail "not every picture is in the page"
fi

# Lines as programs read them.
if command -v python3 >/dev/null 2>&1; then
  python3 -c 'import json, sys
for line in open(sys.argv[1]): json.loads(line)' "$out/results.jsonl" || fail "results.jsonl is no JSON Lines"
fi

# From what is kept, the same again.
cp "$page" "$dir/before"
before=$(cksum <"$out/results.jsonl")
report || fail "lab --all --short failed the second time"
cmp -s "$page" "$dir/before" || fail "the same results make another page"
[ "$(cksum <"$out/results.jsonl")" = "$before" ] || fail "runs were done again"

refuses() {
  words=$1
  shift
  "$tool" lab "$@" >"$dir/out" 2>"$dir/err"
  [ $? -eq 64 ] && grep -q -- "$words" "$dir/err" || fail "lab $* is not refused"
}
printf '#!/bin/sh\nexit 3\n' >"$dir/failing" && chmod +x "$dir/failing"
report --peers "$dir/failing"
[ $? -eq 70 ] && grep -q 'failing failed: the report has of other engines what it left' "$dir/err" ||
  fail "peers that fail go unnoticed"
[ "$(cat "$dir/out")" = "$page" ] || fail "no page where peers fail"
refuses "needs a directory" --all --out ''
echo "the report is whole"
