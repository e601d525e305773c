# Step time against error in scenes after the peers' own benchmarks, from theirs.tsv.
# Called as: gnuplot -e "data='theirs.tsv'; out='theirs.png'" theirs.gp
# SPDX-License-Identifier: MIT
if (!exists("data")) data = "theirs.tsv"
if (!exists("out")) out = "theirs.png"
heading = "Step time against error, in Box3D's and Jolt's own scenes"
scenes = "large_pyramid many_pyramids jolt_pyramid convex_pile junkyard convex_on_land joint_grid human_rain"
titles = "'large pyramid of 5050: overlap' '196 pyramids of 55: overlap' 'pyramid of 1240 (Jolt): overlap' " . \
  "'5120 boulders: overlap' 'junkyard of 10 584: overlap' '1764 shapes on land (Jolt): overlap' " . \
  "'net of 19 700 joints: worst joint' '300 figures rain: worst joint'"
load ARG0[1:strstrt(ARG0, "theirs.gp") - 1]."speed_accuracy.gp"
