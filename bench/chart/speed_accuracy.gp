# Step time against error, ours and peers, in eight scenes, from speed_accuracy.tsv. theirs.gp has others.
# Called as: gnuplot -e "data='speed_accuracy.tsv'; out='speed_accuracy.png'" speed_accuracy.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "speed_accuracy.tsv"
if (!exists("out")) out = "speed_accuracy.png"
height = 1000
load ARG0[1:strstrt(ARG0, "speed_accuracy.gp") - 1]."style.gp"
set output out

set datafile separator tab
stats data skip 1 using (day = strcol(1), 1) nooutput
if (!exists("scenes")) {
  heading = "Step time against error"
  scenes = "S1 S2 S3 S4 S5 S9 S6 S7"
  titles = "'S1  stack of 20: sag' 'S2  wall of 210: worst overlap' 'S3  pyramid of 1240: worst overlap' " . \
    "'S4  pile of 1000: mean overlap' 'S5  4000 spheres: mean overlap' 'S9  drum of 600: worst overlap' " . \
    "'S6  chain with 100 kg: worst joint' 'S7  50 ragdolls: worst joint'"
}
engines = "float double q16.16 q32.32"
# Other engines are letters: at their defaults, for their best settings would be as many again.
peers = "bullet dart havok jolt mujoco ode physx-pgs physx-tgs rapier-simd rapier-det box3d jolt-native"
letters = "B D H J M O P T R r X N"
names = "'float' 'double' 'Q16.16' 'Q32.32'"
titles_of_peers = "'Bullet' 'DART' 'Havok' 'Jolt' 'MuJoCo' 'ODE' 'PhysX, PGS' 'PhysX, TGS' 'Rapier, SIMD' 'Rapier, det.' 'Box3D *' 'Jolt, native *'"

# Ours filled in the colours of style.gp.
violet = "#8250df"
array mark[4] = [7, 5, 9, 13]
do for [k = 1:4] { set style line k linecolor rgb colours[k] pointtype mark[k] pointsize 1.35 linewidth 1 }
set style line 20 linecolor rgb "#cf222e" pointtype 2 pointsize 1.0 linewidth 2

# Runs that kept their scene, at their error; those that lost it, at the upper edge.
kept(scene, engine) = strcol(2) eq scene && strcol(3) eq engine && $6 == 0
lost(scene, engine) = strcol(2) eq scene && strcol(3) eq engine && $6 != 0
unset mxtics
unset mytics
unset key
# No logarithm shows an error of 0: what is less than a micrometre stands at one.
least = 1e-3
error(mm) = mm < least ? least : mm
small = font(11)
set xtics font small
set ytics font small

set multiplot
set label 1 heading at screen 0.06, 0.977 left font font(18) textcolor rgb ink
set label 2 "CPU time of a step [ms] across, error [mm] up, both logarithmic. Left is faster, down more accurate. " . day \
  at screen 0.06, 0.953 left font font(12) textcolor rgb muted
place(k) = 0.293 - 0.022 * (k - 1)
do for [k = 1:12] {
  set label 30 + k word(letters, k) . "  " . word(titles_of_peers, k) at screen 0.725 + 0.13 * ((k - 1) / 6), \
    place(5.4 + (k - 1) % 6) left font font(12) textcolor rgb violet noenhanced
}
set label 22 "* by an earlier ratio to Rapier SIMD" at screen 0.725, 0.062 left font font(10) textcolor rgb muted
do for [k = 1:4] {
  set label 10 + k word(names, k) at screen 0.725, place(k) left offset 1.6, -0.25 point linestyle k font font(12) textcolor rgb ink
}
set label 21 "lost its scene; at the top" at screen 0.725, 0.038 left offset 1.6, -0.25 \
  point linestyle 20 font font(12) textcolor rgb ink
do for [n = 1:8] {
  scene = word(scenes, n)
  left = 0.06 + 0.325 * ((n - 1) % 3)
  bottom = 0.68 - 0.319 * ((n - 1) / 3)
  set lmargin at screen left
  set rmargin at screen left + 0.27
  set bmargin at screen bottom
  set tmargin at screen bottom + 0.225
  set title word(titles, n) font font(12) offset 0, -0.3
  unset logscale
  set autoscale
  stats data skip 1 using (strcol(2) eq scene ? $4 : NaN) name "T" nooutput
  stats data skip 1 using (strcol(2) eq scene && $6 == 0 ? error($5) : NaN) name "E" nooutput
  set logscale xy
  set xrange [T_min / 1.3:T_max * 1.3]
  top = E_max * 2.2
  set yrange [E_min / 1.6:top]
  set xtics ()
  set ytics ()
  do for [decade = -4:4] {
    do for [step in "1 2 5"] {
      value = step * 10.0 ** decade
      set xtics add (sprintf("%g", value) value)
      set ytics add ((top < 100 * E_min || step == 1 ? sprintf("%g", value) : "") value)
    }
  }
  plot for [k = 1:12] data skip 1 using (kept(scene, word(peers, k)) ? $4 : NaN):(error($5)):(word(letters, k)) with labels \
         font font(11) textcolor rgb violet, \
       for [k = 1:12] data skip 1 using (lost(scene, word(peers, k)) ? $4 : NaN):(top):(word(letters, k)) with labels \
         font font(11) textcolor rgb violet offset -1, 0, \
       for [k = 1:4] data skip 1 using (lost(scene, word(engines, k)) ? $4 : NaN):(top) with points linestyle k, \
       for [k = 1:4] data skip 1 using (lost(scene, word(engines, k)) ? $4 : NaN):(top) with points linestyle 20, \
       for [k = 1:12] data skip 1 using (lost(scene, word(peers, k)) ? $4 : NaN):(top) with points linestyle 20, \
       for [k = 1:4] data skip 1 using (kept(scene, word(engines, k)) ? $4 : NaN):(error($5)) with points linestyle k
  unset label
}
unset multiplot
