# SPDX-License-Identifier: MIT
# nearest-epsilon.gp - the ratio found against the ratio proven, and what it saves.
set multiplot layout 1,2
set xlabel "epsilon"
set title "Distance found / true: worst (points), mean (thin)"
set key inside top left
set xrange [-0.05:2.1]
set yrange [0.95:3.05]
plot 1 + x with lines linewidth 3 linecolor rgb "black" title "proven: 1 + epsilon", \
     rows("pairs-at-the-bound", "pairs") using "setting":"worst_ratio" with points pointtype 2 pointsize 1.6 \
         linewidth 2 linecolor rgb "#b3261e" title "pairs made to be worst", \
     for [i = 1:words(scenes) - 1] rows(word(scenes, i), "k1") using "setting":"worst_ratio" with points \
         pointtype mark(i) linecolor rgb colour(i) title word(scenes, i), \
     for [i = 1:words(scenes) - 1] rows(word(scenes, i), "k1") using "setting":"mean_ratio" with lines linewidth 0.5 \
         linecolor rgb colour(i) notitle
set title "Nodes visited (lines), time (points); 1: at epsilon 0"
set yrange [0:1.25]
set key outside right
plot for [i = 1:words(scenes) - 1] first = NaN rows(word(scenes, i), "k1") \
         using "setting":(first = (first == first ? first : column("nodes")), column("nodes") / first) with lines \
         linewidth 2 linecolor rgb colour(i) title word(scenes, i), \
     for [i = 1:words(scenes) - 1] first = NaN rows(word(scenes, i), "k1") \
         using "setting":(first = (first == first ? first : column("ns")), column("ns") / first) with points \
         pointtype mark(i) linecolor rgb colour(i) notitle
unset multiplot
