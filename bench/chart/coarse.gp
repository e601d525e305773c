# What coarse structures cost a frame, and a query, from coarse.tsv.
# Called as: gnuplot -e "data='coarse.tsv'; out='coarse.png'" coarse.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "coarse.tsv"
if (!exists("out")) out = "coarse.png"
height = 640
load ARG0[1:strstrt(ARG0, "coarse.gp") - 1]."style.gp"
set output out

set datafile separator tab
set logscale xy
fields = "'sparse level' 'dense level' 'all sizes' 'debris'"
names = "box_tree sphere_tree bsp_tree quad_tree oct_tree grid multi_grid sweep_and_prune"
titles = "'box tree' 'sphere tree' 'BSP tree' 'quad-tree' 'oct-tree' 'grid' 'multi-grid' 'sweep and prune'"
array shade[8] = ["#222222", "#e69f00", "#56b4e9", "#009e73", "#0072b2", "#d55e00", "#cc79a7", "#8c959f"]
array mark[8] = [5, 7, 9, 13, 11, 15, 6, 4]
at(field, structure, value) = strcol(1) eq field && strcol(4) eq structure && strcol(3) eq "float" ? value : NaN

set multiplot
set label 1 "Coarse structures: a frame and a query, against the number of boxes" \
  at screen 0.06, 0.962 left font font(18) textcolor rgb ink
set label 2 "float, one thread. Above: to move every box and find all pairs. Below: what overlaps a box of 2 m. Lower is faster." \
  at screen 0.06, 0.918 left font font(11) textcolor rgb muted
do for [k = 1:8] {
  set label 10 + k word(titles, k) at screen 0.075 + 0.235 * ((k - 1) % 4), 0.065 - 0.038 * ((k - 1) / 4) \
    left offset 1.2, -0.15 point linetype 1 linecolor rgb shade[k] pointtype mark[k] pointsize 0.9 font font(11) textcolor rgb ink
}
small = font(10)
set xtics font small
set ytics font small
set xrange [70:14000]
unset mxtics
unset mytics
unset key
do for [row = 1:2] {
  do for [n = 1:4] {
    left = 0.1 + 0.228 * (n - 1)
    set lmargin at screen left
    set rmargin at screen left + 0.205
    set tmargin at screen row == 1 ? 0.85 : 0.47
    set bmargin at screen row == 1 ? 0.53 : 0.15
    if (row == 1) { set title word(fields, n) font font(13) offset 0, -0.5 } else { unset title }
    if (row == 1) { set yrange [30:30000] } else { set yrange [30:30000] }
    if (row == 1) { set xtics ("" 100, "" 1000, "" 10000) } else { set xtics ("100" 100, "1000" 1000, "10 000" 10000) }
    if (n == 1) {
      set ytics ("30 ns" 30, "100 ns" 100, "300 ns" 300, "1 µs" 1000, "3 µs" 3000, "10 µs" 10000, "30 µs" 30000)
      set ylabel row == 1 ? "a box and frame" : "a query" font small offset 3.2, 0
    } else {
      set ytics ("" 30, "" 100, "" 300, "" 1000, "" 3000, "" 10000, "" 30000)
      unset ylabel
    }
    plot for [k = 1:8] data skip 1 using 2:(at(word(fields, n), word(names, k), row == 1 ? $11 : $8)) \
      with points linecolor rgb shade[k] pointtype mark[k] pointsize 0.9 linewidth 1.4
    unset label
  }
}
unset multiplot
