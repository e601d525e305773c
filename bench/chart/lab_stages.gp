# What each stage of a step costs, a bar a scalar, from lab_stages.tsv (isostep lab --all).
# Called as: gnuplot -e "data='lab_stages.tsv'; out='lab_stages.png'" lab_stages.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "lab_stages.tsv"
if (!exists("out")) out = "lab_stages.png"
height = 430
load ARG0[1:strstrt(ARG0, "lab_stages.gp") - 1]."style.gp"
set output out

set datafile separator tab
scenes = "S3 S4 S7"
titles = "'S3  pyramid of 1240' 'S4  pile of 1000' 'S7  50 ragdolls'"
scalars = "float double q16.16 q32.32"
# Those that are seen, from the bottom up; the rest together on top.
stages = "find_pairs update_manifolds prepare solve_substeps"
names = "'find pairs' 'update manifolds' 'prepare' 'solve sub-steps' 'all else'"
array hue[5] = ["#0072b2", "#e69f00", "#cc79a7", "#009e73", "#8c959f"]
small = font(11)

set multiplot
set label 1 "What each stage of a step costs" at screen 0.06, 0.94 left font font(18) textcolor rgb ink
set label 2 "ms of CPU time a step, soft step at 8 sub-steps" at screen 0.06, 0.88 \
  left font font(12) textcolor rgb muted
do for [k = 1:5] {
  set label 10 + k word(names, k) at screen 0.06 + 0.17 * (k - 1), 0.815 left offset 1.4, -0.2 \
    point linecolor rgb hue[k] pointtype 5 pointsize 1.1 textcolor rgb ink font font(12)
}
set style fill solid border rgb "#ffffff"
set boxwidth 0.7
unset key
set xrange [0.4:4.6]
set xtics () font small scale 0
do for [k = 1:4] { set xtics add (word(scalars, k) k) }
set ytics font small
set grid noxtics
array sums[20]
do for [n = 1:3] {
  scene = word(scenes, n)
  do for [k = 1:4] {
    below = 0
    do for [m = 1:5] {
      stats data skip 1 using (strcol(1) eq scene && strcol(2) eq word(scalars, k) \
        && (m == 5 || strcol(3) eq word(stages, m)) ? $4 : NaN) name "U" nooutput
      below = m == 5 ? U_sum / 1000 : below + U_sum / 1000
      sums[(k - 1) * 5 + m] = below
    }
  }
  left = 0.06 + 0.325 * (n - 1)
  set lmargin at screen left
  set rmargin at screen left + 0.275
  set bmargin at screen 0.09
  set tmargin at screen 0.68
  set title word(titles, n) font font(13) offset 0, -0.4
  set yrange [0:*]
  set datafile separator whitespace  # of arrays
  plot for [m = 5:1:-1] sums using ((int($1) - 1) % 5 + 1 == m ? (int($1) - 1) / 5 + 1 : NaN):2 with boxes \
    linecolor rgb hue[m]
  set datafile separator tab
  unset label
}
unset multiplot
