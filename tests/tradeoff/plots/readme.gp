# SPDX-License-Identifier: MIT
# readme.gp - the two pictures of the README, from what octree-tradeoff wrote into a folder. What they show is counted and
# not timed: the same on every machine.
#   gnuplot -e "folder='build/tradeoff'" tests/tradeoff/plots/readme.gp && cp build/tradeoff/readme-*.png tests/tradeoff/
set terminal pngcairo size 560,380 font ",11" background rgb "#ffffff"
set datafile separator ","
set datafile columnheaders
set grid linecolor rgb "#e3e6ea"
set border 3 linecolor rgb "#5a6675"
set tics nomirror
set key inside top left reverse Left samplen 1.5 font ",10"
rows(knob, scene, variant) = sprintf("< awk -F, -v s='%s' -v v='%s' 'NR == 1 || ($1 == s && $2 == v)' '%s/%s.csv'", \
                                     scene, variant, folder, knob)

set output folder . "/readme-epsilon.png"
set xlabel "epsilon"
set ylabel "distance found / true distance"
set xrange [-0.05:2.1]
set yrange [0.9:3.4]
plot 1 + x with lines linewidth 3 linecolor rgb "black" title "proven: 1 + epsilon", \
     rows("nearest-epsilon", "pairs-at-the-bound", "pairs") using "setting":"worst_ratio" with points pointtype 2 \
         pointsize 1.4 linewidth 2 linecolor rgb "#b3261e" title "worst of pairs made to be worst", \
     rows("nearest-epsilon", "clustered", "k1") using "setting":"worst_ratio" with points pointtype 7 \
         pointsize 1.3 linecolor rgb "#0072b2" title "worst of clustered points", \
     rows("nearest-epsilon", "uniform", "k1") using "setting":"worst_ratio" with points pointtype 6 pointsize 1.3 \
         linewidth 2 linecolor rgb "#d55e00" title "worst of uniform points", \
     rows("nearest-epsilon", "uniform", "k1") using "setting":"mean_ratio" with lines linewidth 1 \
         linecolor rgb "#d55e00" title "their mean"

set output folder . "/readme-sweep.png"
set logscale x 2
set xlabel "speed: a step / the side of the player's box"
set ylabel "collisions missed, %"
set xrange [0.2:20]
set yrange [-3:135]
set ytics 0, 20, 100
plot rows("sweep", "uniform", "swept-slantwise") using "setting":(100 * column("bound_share")) with lines linewidth 3 \
         linecolor rgb "black" title "swept, proven: none", \
     rows("sweep", "uniform", "ends-on-axis") using "setting":(100 * column("missed_share")) with points pointtype 5 \
         pointsize 1.7 linecolor rgb "#d55e00" title "ends of a step along an axis (proven: none up to 1)", \
     rows("sweep", "uniform", "ends-slantwise") using "setting":(100 * column("missed_share")) with points pointtype 4 \
         pointsize 1.7 linewidth 2 linecolor rgb "#d55e00" title "ends of a slanting step", \
     rows("sweep", "uniform", "swept-slantwise") using "setting":(100 * column("missed_share")) with points pointtype 7 \
         pointsize 0.9 linecolor rgb "#0072b2" title "swept, measured"
