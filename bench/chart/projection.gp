# What it costs to find the worst contact, from projection.tsv.
# Called as: gnuplot -e "data='projection.tsv'; out='projection.png'" projection.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "projection.tsv"
if (!exists("out")) out = "projection.png"
height = 460
load ARG0[1:strstrt(ARG0, "projection.gp") - 1]."style.gp"
set output out

set datafile separator tab
set logscale xy
names = "'tree' 'sorted list' 'linear search'"
array shade[3] = ["#222222", "#0072b2", "#d55e00"]
array mark[3] = [5, 7, 9]
at(queue, value) = strcol(4) eq queue ? value : NaN

set label 1 "A step of the worst-first resolver, against the number of contacts" \
  at screen 0.06, 0.95 left font font(18) textcolor rgb ink
set label 2 "float, one thread, 4 sub-steps of a pile that falls, by what finds the worst contact. Lower is faster." \
  at screen 0.06, 0.89 left font font(11) textcolor rgb muted
small = font(10)
set lmargin at screen 0.11
set rmargin at screen 0.95
set tmargin at screen 0.82
set bmargin at screen 0.16
set xtics ("10" 10, "30" 30, "100" 100, "300" 300, "1000" 1000) font small
set ytics ("10 µs" 10, "100 µs" 100, "1 ms" 1000, "10 ms" 10000, "100 ms" 100000) font small
set xrange [10:1500]
set yrange [5:100000]
set xlabel "contacts" font small
unset mxtics
unset mytics
set key top left font small
plot for [k = 1:3] data skip 1 using 2:(at(word(names, k), $5)) title word(names, k) \
  with points linecolor rgb shade[k] pointtype mark[k] pointsize 1 linewidth 1.4
