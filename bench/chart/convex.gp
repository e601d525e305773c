# Time against error of the convex algorithms, from convex.tsv.
# Called as: gnuplot -e "data='convex.tsv'; out='convex.png'" convex.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "convex.tsv"
if (!exists("out")) out = "convex.png"
height = 560
load ARG0[1:strstrt(ARG0, "convex.gp") - 1]."style.gp"
set output out

set datafile separator tab
set logscale xy
kinds = "near touching deep"
titles = "'apart by up to 10 cm' 'at rest on one another' 'pushed deep into one another'"
algorithms = "sat sat_one_lane gjk epa v_clip v_clip_warm"
names = "'SAT, wide' 'SAT, one lane' 'GJK' 'EPA' 'V-Clip' 'V-Clip, warm'"
scalars = "float double q16.16 q32.32"
array mark[6] = [5, 4, 7, 9, 13, 12]

# What says only that they overlap stands at the lower edge.
bottom = 1e-10
error(value) = value < 0 ? bottom : 1e6 * value < 3 * bottom ? 3 * bottom : 1e6 * value
at(kind, scalar, algorithm, value) = \
  strcol(1) eq kind && strcol(2) eq scalar && strcol(3) eq algorithm ? value : NaN

set multiplot
set label 1 "Time of a pair of hulls against error" at screen 0.06, 0.955 left font font(18) textcolor rgb ink
set label 2 "Pairs of S10. Worst error of distance or depth up (of SAT: of its axis), CPU time across. Left is faster, down more exact." \
  at screen 0.06, 0.905 left font font(11) textcolor rgb muted
do for [k = 1:6] {
  set label 10 + k word(names, k) at screen 0.075 + 0.155 * (k - 1), 0.075 left offset 1.2, -0.15 \
    point linetype 1 linecolor rgb ink pointtype mark[k] pointsize 1 font font(11) textcolor rgb ink
}
do for [k = 1:4] {
  set label 20 + k word(scalars, k) at screen 0.075 + 0.155 * (k - 1), 0.03 left offset 1.2, -0.15 \
    point linetype 1 linecolor rgb colours[k] pointtype 7 pointsize 1 font font(11) textcolor rgb ink
}
small = font(11)
set xtics font small
set ytics font small
set xrange [150:20000]
set yrange [0.4 * bottom:1e5]
set xtics ("200 ns" 200, "500" 500, "1 µs" 1000, "2" 2000, "5" 5000, "10" 10000)
set ytics ("overlap" bottom, "1 fm" 1e-9, "1 pm" 1e-6, "1 nm" 1e-3, "1 µm" 1, "1 mm" 1e3)
unset mxtics
unset mytics
unset key
do for [n = 1:3] {
  left = 0.095 + 0.305 * (n - 1)
  set lmargin at screen left
  set rmargin at screen left + 0.28
  set bmargin at screen 0.18
  set tmargin at screen 0.82
  set title word(titles, n) font font(13) offset 0, -0.5
  if (n == 2) {
    set ytics ("" bottom, "" 1e-9, "" 1e-6, "" 1e-3, "" 1, "" 1e3)
  }
  plot for [s = 1:4] for [k = 1:6] data skip 1 \
    using (at(word(kinds, n), word(scalars, s), word(algorithms, k), $5)):(error($6)) \
    with points linecolor rgb colours[s] pointtype mark[k] pointsize 1 linewidth 1.6
  unset label
}
unset multiplot
