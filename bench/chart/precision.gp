# Cost against error, from precision.tsv. Called as: gnuplot -e "data='precision.tsv'; out='precision.svg'" precision.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "precision.tsv"
if (!exists("out")) out = "precision.svg"
height = 800
load ARG0[1:strstrt(ARG0, "precision.gp") - 1]."style.gp"
set output out

set datafile separator tab
set logscale xy
set format x "%g"
set yrange [5e-8:3e5]
set ytics ("" 1e-7, "1 nm" 1e-6, "" 1e-5, "" 1e-4, "1 µm" 1e-3, "" 1e-2, "" 1e-1, "1 mm" 1, "" 10, "" 100, \
  "1 m" 1e3, "" 1e4)
unset mxtics
scenes = "pendulum top slope stack"
titles = "'Pendulum, 4 s: along its path' 'Heavy top, 4 s: along its path' " . \
  "'Box stopping on a 20° slope: its place' '20 boxes stacked for 10 s: their height'"
scalars = "float double q16.16 q32.32"
array low[4] = [0.6, 0.6, 1, 8]
array high[4] = [8, 8, 26, 150]
# The rows of one scene and scalar, one column against the cost.
at(scene, scalar, value) = strcol(1) eq scene && strcol(2) eq scalar ? value : NaN

set multiplot
set label 1 "Error against cost: sub-steps first, the scalar second" \
  at screen 0.06, 0.975 left font font(18) textcolor rgb ink
set label 2 "Four points a line: 2, 4, 8, 16 sub-steps. Right and down is slower and better." \
  at screen 0.06, 0.945 left font font(13) textcolor rgb muted
set label 3 "filled: error against double at 64 sub-steps (stack: against the ideal height)" \
  at screen 0.34, 0.058 left font font(12) textcolor rgb ink
set label 4 "hollow: rounding alone, against double with as many sub-steps" \
  at screen 0.34, 0.026 left font font(12) textcolor rgb ink
do for [k = 1:4] {
  set label 10 + k word(scalars, k) at screen 0.09 + 0.12 * ((k - 1) % 2), 0.062 - 0.032 * ((k - 1) / 2) \
    left offset 1.2, -0.15 point linestyle k textcolor rgb ink
}
do for [n = 1:4] {
  left = n % 2 == 1 ? 0.1 : 0.585
  bottom = n <= 2 ? 0.575 : 0.165
  set lmargin at screen left
  set rmargin at screen left + 0.39
  set bmargin at screen bottom
  set tmargin at screen bottom + 0.295
  set title word(titles, n) font font(14) offset 0, -0.6
  set xlabel (n > 2 ? "µs per step" : "") offset 0, 0.4
  set ylabel (n % 2 == 1 ? "error" : "") offset -0.6, 0
  set xrange [low[n]:high[n]]
  set xtics (0.7, 1, 2, 4, 8, 15, 25, 50, 100)
  unset key
  scene = word(scenes, n)
  plot for [k = 1:4] data skip 1 using (at(scene, word(scalars, k), $4)):6 \
         with linespoints linestyle k, \
       for [k in "1 3 4"] data skip 1 using (at(scene, word(scalars, int(k)), $4)):7 \
         with linespoints linestyle 10 + int(k), \
       data skip 1 using (at(scene, "q32.32", $4)):6:3 \
         with labels left offset 0.3, 0.7 font font(12) textcolor rgb colours[4]
  unset label
}
unset multiplot
