# Step time against error over sub-steps, a panel a scene, from lab_accuracy.tsv (isostep lab --all).
# Called as: gnuplot -e "data='lab_accuracy.tsv'; out='lab_accuracy.png'" lab_accuracy.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "lab_accuracy.tsv"
if (!exists("out")) out = "lab_accuracy.png"
# The scenes that the table has, in its order.
listed(n) = system(sprintf("tail -n +2 '%s' | cut -f%d | uniq", data, n))
scenes = listed(1)
count = words(scenes)
rows = (count + 2) / 3
width = 1200
height = 172 + 362 * rows
load ARG0[1:strstrt(ARG0, "lab_accuracy.gp") - 1]."style.gp"
set output out

set datafile separator tab
scalars = "float double q16.16 q32.32"
solvers = "soft_step pgs worst_first direct avbd admm"
# Colour: the scalar. Mark and dashes: the solver. Peers: letters, with a + at their best settings.
peers = "B Bullet  D DART  H Havok  J Jolt  M MuJoCo  O ODE  P PhysX PGS  T PhysX TGS  R Rapier SIMD  r Rapier deterministic"
letter(engine) = engine[1:6] eq "physx-" ? (engine[7:7] eq "p" ? "P" : "T") : engine[1:10] eq "rapier-det" ? "r" : \
  word("B D H J M O R", strstrt("bdhjmor", engine[1:1]))
sign(engine) = letter(engine) . (strlen(engine) > 5 && engine[strlen(engine) - 4:] eq "-best" ? "+" : "")
violet = "#8250df"
array mark[6] = [7, 6, 9, 5, 11, 13]
array dash[6] = [1, 3, 4, 2, 5, 3]
do for [k = 1:4] {
  do for [m = 1:6] {
    set style line 100 + 10 * k + m linecolor rgb colours[k] dashtype dash[m] linewidth 1.2 \
      pointtype mark[m] pointsize 0.6
  }
}
set style line 30 linecolor rgb "#cf222e" pointtype 2 pointsize 0.7 linewidth 1.4

series(scene, scalar, solver) = strcol(1) eq scene && strcol(5) eq scalar && strcol(6) eq solver
kept(scene, scalar, solver) = series(scene, scalar, solver) && $10 == 0
peer(scene) = strcol(1) eq scene && strcol(4) ne "isostep"
unset mxtics
unset mytics
unset key
small = font(10)
set xtics font small
set ytics font small

set multiplot
place(pixels) = 1 - pixels / real(height)
set label 1 "Speed against accuracy, over sub-steps" at screen 0.04, place(28) left font font(18) textcolor rgb ink
note = "Across: CPU time of 1/60 s, ms. Up: the error in the title. Left is faster, down is more accurate. "
set label 2 note . "Lines: isostep, 2 to 32 sub-steps." \
  at screen 0.04, place(52) left font font(12) textcolor rgb muted
do for [k = 1:4] {
  set label 10 + k word(scalars, k) at screen 0.045 + 0.085 * (k - 1), place(82) left offset 1.4, -0.2 \
    point linecolor rgb colours[k] pointtype 7 pointsize 0.9 textcolor rgb ink font font(12)
}
do for [m = 1:6] {
  set label 20 + m word(solvers, m) at screen 0.4 + 0.1 * (m - 1), place(82) left offset 1.4, -0.2 \
    point linecolor rgb ink pointtype mark[m] pointsize 0.8 textcolor rgb ink font font(12) noenhanced
}
set label 30 peers at screen 0.04, place(106) left textcolor rgb violet font font(12) noenhanced
set label 40 "lost its scene; at the upper edge" at screen 0.045, place(130) left offset 1.4, -0.2 \
  point linestyle 30 textcolor rgb ink font font(12)
set label 41 "+ with an engine's letter: at its best settings.   An error of 1e-06 is that or less." at screen 0.3, place(130) left \
  textcolor rgb violet font font(12)
do for [n = 1:count] {
  scene = word(scenes, n)
  left = 0.078 + 0.318 * ((n - 1) % 3)
  top = 187 + 362 * ((n - 1) / 3)
  set lmargin at screen left
  set rmargin at screen left + 0.262
  set tmargin at screen place(top)
  set bmargin at screen place(top + 262)
  unset logscale
  set autoscale
  stats data skip 1 using (strcol(1) eq scene ? (title = strcol(2), unit = strcol(3), $8) : NaN) name "T" nooutput
  stats data skip 1 using (strcol(1) eq scene && $10 == 0 ? $9 : NaN) name "E" nooutput
  set title scene . "  " . title . " [" . unit . "]" font font(12) offset 0, -0.4 noenhanced
  set logscale xy
  set xrange [T_min / 1.3:T_max * 1.3]
  upper = E_max * 2.5
  set yrange [E_min / 1.8:upper]
  set xtics ()
  set ytics ()
  do for [decade = -9:7] {
    do for [step in "1 2 5"] {
      value = step * 10.0 ** decade
      set xtics add ((step == 1 || T_max < 60 * T_min ? sprintf("%g", value) : "") value)
      if (step == 1 || upper < 100 * E_min) { set ytics add (sprintf("%g", value) value) }
    }
  }
  set xlabel "CPU time of 1/60 s [ms]" font small offset 0, 0.8
  set ylabel (n % 3 == 1 ? "error, in the title's unit" : "") font small offset 1.5, 0
  plot for [k = 1:4] for [m = 1:6] data skip 1 \
         using (kept(scene, word(scalars, k), word(solvers, m)) ? $8 : NaN):9 with linespoints \
         linestyle 100 + 10 * k + m, \
       for [k = 1:4] for [m = 1:6] data skip 1 \
         using (series(scene, word(scalars, k), word(solvers, m)) && $10 != 0 ? $8 : NaN):(upper) with points \
         linecolor rgb colours[k] pointtype mark[m] pointsize 0.6, \
       data skip 1 using (peer(scene) ? $8 : NaN):($10 == 0 ? $9 : upper):(sign(strcol(4))) with labels \
         font font(10) textcolor rgb violet noenhanced, \
       data skip 1 using (strcol(1) eq scene && $10 != 0 ? $8 : NaN):(upper) with points linestyle 30
  unset label
}
unset multiplot
