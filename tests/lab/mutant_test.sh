#!/bin/sh
# A bug of accuracy moves the laboratory's figures: one constant is wrong, and a stack of five sinks. Compiling alone
# moves nothing.
# SPDX-License-Identifier: MIT
# usage: mutant_test.sh TOOL REBUILT MUTATED
set -u
. "$(dirname "$0")/../scratch.sh"

# figures TOOL NAME: every column but the times, of the stack in double with 4 sub-steps.
figures() {
  "$1" lab S1x5 --scalars double --solvers soft_step --substeps 4 --frames 300 --out "" --csv "$dir/$2.csv" \
    >"$dir/$2.txt" 2>&1 || {
    cat "$dir/$2.txt" >&2
    exit 1
  }
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i != "ms" && $i != "ms_mean") kept[i] = 1; next }
           $7 == 4 { line = ""; for (i = 1; i <= NF; ++i) if (i in kept) line = line $i ","; print line }' \
    "$dir/$2.csv" >"$dir/$2.figures"
}
# penetration NAME [m]
penetration() {
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "penetration") column = i; next } $7 == 4 { print $column }' \
    "$dir/$1.csv"
}

figures "$1" tool
figures "$2" rebuilt
figures "$3" mutated
[ -s "$dir/tool.figures" ] || { echo "the laboratory wrote no figures" >&2; exit 1; }
cmp "$dir/tool.figures" "$dir/rebuilt.figures" || { echo "compiling again moved the figures" >&2; exit 1; }
right=$(penetration tool) wrong=$(penetration mutated)
awk -v right="$right" -v wrong="$wrong" 'BEGIN { exit !(right > 0 && wrong > 2 * right) }' || {
  echo "penetration $right m, with the wrong constant $wrong m: the laboratory shows no bug" >&2
  exit 1
}
echo "penetration $right m, with the wrong constant $wrong m"
