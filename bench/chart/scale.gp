# Cost of a body against their number, from scale.tsv. Called as: gnuplot -e "data='scale.tsv'; out='scale.png'" scale.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "scale.tsv"
if (!exists("out")) out = "scale.png"
height = 560
load ARG0[1:strstrt(ARG0, "scale.gp") - 1]."style.gp"
set output out

set datafile separator tab
set logscale xy
scenes = "pyramid pile"
titles = "'Pyramids, as S3' 'Piles, as S4'"
# Columns of the table: the step, then its stages; the small ones are left out.
names = "'whole step' 'solve sub-steps' 'update manifolds' 'prepare' 'find pairs' 'finalise bodies' 'colour'"
array place[7] = [4, 10, 7, 9, 5, 13, 8]
array shade[7] = ["#222222", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]
array point[7] = [5, 7, 9, 13, 11, 15, 4]
at(scene, value) = strcol(1) eq scene ? value : NaN
positive(value) = value > 0.5 ? value : NaN  # a stage that does nothing has no place on the scale

set multiplot
set label 1 "Time of a body in a step, against the number of bodies" \
  at screen 0.06, 0.955 left font font(18) textcolor rgb ink
set label 2 "float, nobody asleep, one thread. A flat line costs the same for every body; caches end on the way." \
  at screen 0.06, 0.905 left font font(13) textcolor rgb muted
do for [k = 1:7] {
  set label 10 + k word(names, k) at screen 0.075 + 0.24 * ((k - 1) % 4), 0.082 - 0.046 * ((k - 1) / 4) \
    left offset 1.2, -0.15 point linetype 1 linecolor rgb shade[k] pointtype point[k] pointsize 0.9 textcolor rgb ink
}
set xrange [70:70000]
set yrange [1:10000]
set xtics ("100" 100, "1000" 1000, "10 000" 10000, "50 000" 50000)
set ytics ("1 ns" 1, "10 ns" 10, "100 ns" 100, "1 µs" 1000, "10 µs" 10000)
unset mxtics
unset key
do for [n = 1:2] {
  left = n == 1 ? 0.085 : 0.58
  set lmargin at screen left
  set rmargin at screen left + 0.40
  set bmargin at screen 0.24
  set tmargin at screen 0.82
  set title word(titles, n) font font(14) offset 0, -0.6
  set xlabel "bodies" offset 0, 0.4
  set ylabel (n == 1 ? "a body and step" : "") offset 0.5, 0
  scene = word(scenes, n)
  plot for [k = 1:7] data skip 1 using (at(scene, $2)):(positive(column(place[k]))) \
    with linespoints linecolor rgb shade[k] linewidth (k == 1 ? 2.4 : 1.4) pointtype point[k] pointsize 0.8
  unset label
}
unset multiplot
