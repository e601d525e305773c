# Own vectors against Eigen's, from maths.tsv. Called as: gnuplot -e "data='maths.tsv'; out='maths.png'" maths.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "maths.tsv"
if (!exists("out")) out = "maths.png"
height = 470
load ARG0[1:strstrt(ARG0, "maths.gp") - 1]."style.gp"
set output out

set datafile separator tab
names = "'dot' 'cross' 'rotate' 'matrix · vector' 'matrix · matrix'"
scalars = "float double Q16_16 Q32_32"
shown = "float double q16.16 q32.32"
place(o) = o eq "dot" ? 1 : o eq "cross" ? 2 : o eq "rotate" ? 3 : o eq "mat3_vec3" ? 4 : 5
at(scalar, value) = strcol(2) eq scalar ? value : NaN
bar = 0.225

set lmargin at screen 0.085
set rmargin at screen 0.975
set bmargin at screen 0.19
set tmargin at screen 0.80
set label 1 "Own vectors and matrices against Eigen 3.4 over the same number" \
  at screen 0.06, 0.945 left font font(18) textcolor rgb ink
set label 2 "Solid: ours. Outline: Eigen’s. Figures: our time as a part of Eigen’s. Shorter is faster." \
  at screen 0.06, 0.885 left font font(13) textcolor rgb muted
set xrange [0.45:5.55]
set xtics () scale 0
do for [n = 1:5] { set xtics add (word(names, n) n) }
set yrange [0:*]
set ylabel "ns per operation" offset 0.5, 0
unset grid
set grid ytics linecolor rgb "#d0d7de" linewidth 1 dashtype 1
unset key
do for [k = 1:4] {
  set label 10 + k word(shown, k) at screen 0.10 + 0.11 * (k - 1), 0.06 \
    left offset 1.3, -0.2 point linestyle k pointtype 5 pointsize 1.4 textcolor rgb ink
}
middle(k) = place(strcol(1)) + (k - 2.5) * bar
plot for [k = 1:4] data skip 1 using (at(word(scalars, k), middle(k))):4:(bar * 0.94) \
       with boxes fillstyle empty linecolor rgb colours[k] linewidth 1.4, \
     for [k = 1:4] data skip 1 using (at(word(scalars, k), middle(k))):3:(bar * 0.56) \
       with boxes fillstyle solid 1.0 noborder linecolor rgb colours[k], \
     for [k = 1:4] data skip 1 using (at(word(scalars, k), middle(k))):($3 > $4 ? $3 : $4):(sprintf("%.2f", $5)) \
       with labels offset 0, 0.6 font font(10) textcolor rgb ink
