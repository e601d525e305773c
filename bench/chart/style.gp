# What the charts share: an opaque ground, legible on light and dark pages, and colours told apart by everybody.
# SPDX-License-Identifier: MIT
if (!exists("width")) width = 960
if (!exists("height")) height = 760
ink = "#24292f"
muted = "#57606a"
# Points of a PNG are larger than those of an SVG.
png = out[strlen(out) - 3:] eq ".png"
font(size) = sprintf("sans-serif,%d", png ? size : size * 1.2 + 0.5)
if (png) {
  set terminal pngcairo size width, height background rgb "#ffffff" font font(13) enhanced
} else {
  set terminal svg size width, height dynamic background "#ffffff" font font(13) enhanced
}
set encoding utf8
set border 3 linecolor rgb ink
set tics nomirror textcolor rgb ink
set xlabel textcolor rgb ink
set ylabel textcolor rgb ink
set title textcolor rgb ink
set key textcolor rgb ink
set grid linecolor rgb "#d0d7de" linewidth 1 dashtype 1

# float, double, q16.16, q32.32, after Okabe and Ito; + 10: hollow and dotted.
array colours[4] = ["#0072b2", "#222222", "#d55e00", "#009e73"]
array solid[4] = [7, 5, 9, 13]
array hollow[4] = [6, 4, 8, 12]
do for [k = 1:4] {
  set style line k linecolor rgb colours[k] linewidth 1.6 pointtype solid[k] pointsize 0.9
  set style line 10 + k linecolor rgb colours[k] linewidth 1.1 dashtype 3 pointtype hollow[k] pointsize 0.9
}
