# Energy after 10 s against stiffness, and time of a step, from springs.tsv (isostep lab springs --out DIRECTORY).
# Called as: gnuplot -e "data='springs.tsv'; out='springs.png'" springs.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "springs.tsv"
if (!exists("out")) out = "springs.png"
height = 1010
load ARG0[1:strstrt(ARG0, "springs.gp") - 1]."style.gp"
set output out

set datafile separator tab
systems = "oscillator net"
scalars = "float double q16.16 q32.32"
methods = "explicit_euler semi_implicit_euler velocity_verlet rk4 implicit_euler stiff_spring"
names = "'explicit Euler' 'semi-implicit Euler' 'velocity Verlet' 'RK4' 'implicit Euler' 'stiff spring (exact)'"
array hue[6] = ["#d55e00", "#0072b2", "#009e73", "#cc79a7", "#222222", "#e69f00"]
array mark[6] = [2, 7, 5, 9, 13, 11]
array wide[6] = [1.6, 1.6, 1.6, 1.6, 1.6, 5]  # the last is drawn first, below those that hold the energy as it does
low = 1e-5
top = 1e5
do for [k = 1:6] { set style line k linecolor rgb hue[k] linewidth wide[k] pointtype mark[k] pointsize 0.6 }
set style line 21 linecolor rgb "#cf222e" linewidth 1.6 pointtype 2 pointsize 0.7

of(system, scalar, method) = strcol(1) eq system && strcol(2) eq scalar && strcol(3) eq method
whole(system, scalar, method) = of(system, scalar, method) && strcol(5) ne "exploded" ? $6 : NaN
# Exploded ones at the upper edge, a method a row, so that they do not hide each other.
lost(system, scalar, k) = of(system, scalar, word(methods, k)) && strcol(5) eq "exploded" ? top / 2.4 ** k : NaN

small = font(11)
set multiplot
set label 1 "Stiff springs: energy after 10 s, of that at the start" at screen 0.06, 0.975 left font font(18) textcolor rgb ink
set label 2 "Across: k h²/m of one spring. × exploded, one row a method. A line that falls loses energy; one at 1 keeps it." \
  at screen 0.06, 0.95 left font font(13) textcolor rgb muted
do for [k = 1:6] {
  set label 10 + k word(names, k) at screen 0.075 + 0.31 * ((k - 1) % 3), 0.923 - 0.024 * ((k - 1) / 3) \
    left offset 1.4, -0.2 point linetype 1 linecolor rgb hue[k] pointtype (k == 1 ? 2 : mark[k]) pointsize 0.9 textcolor rgb ink
}
set label 31 "One particle on one spring" at screen 0.06, 0.868 left font font(14) textcolor rgb ink
set label 32 "A net of 8 × 8 particles, whose stiffest mode is 7.76 times as stiff as a spring" \
  at screen 0.06, 0.567 left font font(14) textcolor rgb ink
set label 33 "Time of a step: one particle (hollow), net (solid)" at screen 0.06, 0.262 left font font(14) textcolor rgb ink
set logscale xy
set xrange [0.008:12500]
set yrange [low:top]
set xtics ("0.01" 0.01, "1" 1, "100" 100, "10^4" 1e4) font small
set ytics ("10^{-5}" 1e-5, "" 1e-4, "10^{-3}" 1e-3, "" 1e-2, "0.1" 0.1, "1" 1, "10" 10, "" 100, "10^3" 1e3, "" 1e4, "10^5" 1e5) \
  font small
unset mxtics
unset mytics
unset key
do for [row = 1:2] {
  system = word(systems, row)
  do for [column = 1:4] {
    scalar = word(scalars, column)
    left = 0.07 + 0.232 * (column - 1)
    set lmargin at screen left
    set rmargin at screen left + 0.205
    bottom = row == 1 ? 0.625 : 0.325
    set bmargin at screen bottom
    set tmargin at screen bottom + 0.20
    set title scalar font font(12) offset 0, -0.7
    if (column > 1) { set format y ""; set ytics ("" 1e-5, "" 1e-3, "" 0.1, "" 1, "" 10, "" 1e3, "" 1e5) }
    if (column == 1) { set ytics ("10^{-5}" 1e-5, "10^{-3}" 1e-3, "0.1" 0.1, "1" 1, "10" 10, "10^3" 1e3, "10^5" 1e5) font small }
    plot for [k in "6 5 4 3 2 1"] data skip 1 using 4:(whole(system, scalar, word(methods, int(k)))) \
           with linespoints linestyle int(k), \
         for [k = 1:6] data skip 1 using 4:(lost(system, scalar, k)) \
           with points linecolor rgb hue[k] linewidth 1.4 pointtype 2 pointsize 0.55
    unset label
  }
}
# Median over all stiffnesses.
set lmargin at screen 0.07
set rmargin at screen 0.97
set bmargin at screen 0.045
set tmargin at screen 0.235
unset title
unset logscale x
set autoscale xy  # stats sees nothing beyond the ranges
array times[48]
do for [row = 1:2] {
  do for [column = 1:4] {
    do for [k = 1:6] {
      stats data skip 1 using (of(word(systems, row), word(scalars, column), word(methods, k)) ? $8 : NaN) name "T" nooutput
      times[(row - 1) * 24 + (column - 1) * 6 + k] = T_median
    }
  }
}
set xrange [0.5:6.5]
set yrange [50:1000000]
set xtics () scale 0
do for [k = 1:6] { set xtics add (word(names, k) k) }
set ytics ("100 ns" 100, "1 µs" 1000, "10 µs" 10000, "100 µs" 100000)
do for [c = 1:4] {
  set label 40 + c word(scalars, c) at screen 0.55 + 0.105 * (c - 1), 0.262 left offset 1.2, -0.2 \
    point linetype 1 linecolor rgb colours[c] pointtype solid[c] pointsize 0.9 textcolor rgb ink
}
set datafile separator whitespace  # of arrays
method(i) = (int(i) - 1) % 6 + 1
plot for [c = 1:4] for [row = 1:2] times \
  using ((int($1) - 1) / 6 == (row - 1) * 4 + c - 1 ? method($1) + 0.09 * (c - 2.5) : NaN):2 with points \
  linecolor rgb colours[c] pointtype (row == 1 ? hollow[c] : solid[c]) pointsize 0.9
unset multiplot
