# SPDX-License-Identifier: MIT
# range-epsilon.gp - how far outside, how many too many, and what it saves.
set multiplot layout 1,3
set key inside top left maxrows 7 font ",8"
set xlabel "epsilon / size of the range"
set title "Farthest outside / size of the range"
set xrange [-0.02:1.05]
set yrange [0:1.3]
plot x with lines linewidth 3 linecolor rgb "black" title "proven: epsilon", \
     for [i = 1:words(scenes)] rows(word(scenes, i), "box") using "setting":"worst_outside" with points \
         pointtype 4 linecolor rgb colour(i) title word(scenes, i), \
     for [i = 1:words(scenes)] rows(word(scenes, i), "ball") using "setting":"worst_outside" with points \
         pointtype 6 linecolor rgb colour(i) notitle
unset key
set yrange [0:*]
set title "Points too many / points in it"
plot for [i = 1:words(scenes)] rows(word(scenes, i), "box") using "setting":"extra" with linespoints pointtype 4 \
         linecolor rgb colour(i) title word(scenes, i), \
     for [i = 1:words(scenes)] rows(word(scenes, i), "ball") using "setting":"extra" with linespoints pointtype 6 \
         linecolor rgb colour(i) notitle
set yrange [0:1.25]
set title "Time; 1: at epsilon 0 (squares: box, circles: ball)"
plot for [i = 1:words(scenes)] first = NaN rows(word(scenes, i), "box") \
         using "setting":(first = (first == first ? first : column("ns")), column("ns") / first) with linespoints \
         pointtype 4 linecolor rgb colour(i) title word(scenes, i), \
     for [i = 1:words(scenes)] first = NaN rows(word(scenes, i), "ball") \
         using "setting":(first = (first == first ? first : column("ns")), column("ns") / first) with linespoints \
         pointtype 6 linecolor rgb colour(i) title word(scenes, i)
unset multiplot
