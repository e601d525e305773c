# How far each scalar gets from double with time, from lab_growth.tsv (isostep lab --all).
# Called as: gnuplot -e "data='lab_growth.tsv'; out='lab_growth.png'" lab_growth.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "lab_growth.tsv"
if (!exists("out")) out = "lab_growth.png"
height = 720
load ARG0[1:strstrt(ARG0, "lab_growth.gp") - 1]."style.gp"
set output out

set datafile separator tab
scenes = "S6v S6 spinner S4s"
titles = "'S6v  a chain that hangs with 100 kg' 'S6  the same chain, swinging' " . \
  "'a weightless box that turns over and over' 'S4s  a pile of 200 bodies'"
scalars = "float double q16.16 q32.32"
at(scene, scalar) = strcol(1) eq scene && strcol(2) eq scalar && $4 > 0 ? $4 : NaN
small = font(11)
set logscale xy
set format x "%g"
set yrange [1e-12:100]
set ytics ("1 pm" 1e-12, "" 1e-11, "" 1e-10, "1 nm" 1e-9, "" 1e-8, "" 1e-7, "1 µm" 1e-6, "" 1e-5, "" 1e-4, \
  "1 mm" 1e-3, "" 1e-2, "" 0.1, "1 m" 1, "" 10, "" 100) font small
set xtics font small
unset mxtics
unset mytics
unset key

set multiplot
set label 1 "Error growth: from the same method in double" at screen 0.06, 0.972 left font font(18) textcolor rgb ink
set label 2 "Root mean square over bodies, of points half a metre from their centres; seconds simulated across." \
  at screen 0.06, 0.94 left font font(12) textcolor rgb muted
do for [k in "1 3 4"] {
  set label 10 + int(k) word(scalars, int(k)) at screen 0.06 + 0.1 * (int(k) < 3 ? 0 : int(k) - 2), 0.905 \
    left offset 1.4, -0.2 point linestyle int(k) textcolor rgb ink
}
do for [n = 1:4] {
  left = n % 2 == 1 ? 0.085 : 0.575
  bottom = n <= 2 ? 0.505 : 0.065
  set lmargin at screen left
  set rmargin at screen left + 0.4
  set bmargin at screen bottom
  set tmargin at screen bottom + 0.305
  set title word(titles, n) font font(13) offset 0, -0.5
  stats data skip 1 using 3 name "T" nooutput
  set xrange [T_min:T_max]
  plot for [k in "1 3 4"] data skip 1 using 3:(at(word(scenes, n), word(scalars, int(k)))) with lines \
    linestyle int(k) linewidth 2
  unset label
}
unset multiplot
