# SPDX-License-Identifier: MIT
# sweep.gp - collisions missed by speed, and what the sweep costs.
set multiplot layout 1,2
set key inside top left
set logscale x 2
set xlabel "speed: step / side of the player's box"
set xrange [0.2:20]
set yrange [-2:118]
set title "Collisions missed, % (filled: ends on an axis; open: ends slantwise; x: swept)"
plot rows(word(scenes, 1), "swept-on-axis") using "setting":(100 * column("bound_share")) with lines linewidth 4 \
         linecolor rgb "black" title "proven: 0 when swept, and for the ends on an axis up to 1", \
     rows(word(scenes, 1), "ends-on-axis") using "setting":(100 * column("expected_share")) with lines dashtype 2 \
         linewidth 2 linecolor rgb "#5a6675" title "ends on an axis, expected of evenly strewn points", \
     for [i = 1:words(scenes)] rows(word(scenes, i), "ends-on-axis") using "setting":(100 * column("missed_share")) \
         with points pointtype 5 linecolor rgb colour(i) title word(scenes, i), \
     for [i = 1:words(scenes)] rows(word(scenes, i), "ends-slantwise") using "setting":(100 * column("missed_share")) \
         with points pointtype 6 linecolor rgb colour(i) notitle, \
     for [i = 1:words(scenes)] rows(word(scenes, i), "swept-slantwise") using "setting":(100 * column("missed_share")) \
         with points pointtype 2 linecolor rgb colour(i) notitle
set title "Nanoseconds a step (dashed: ends; circles: swept on an axis; x: slantwise)"
set logscale y
set yrange [10:*]
plot for [i = 1:words(scenes)] rows(word(scenes, i), "ends-on-axis") using "setting":"ns" with linespoints \
         pointtype 5 dashtype 2 linecolor rgb colour(i) notitle, \
     for [i = 1:words(scenes)] rows(word(scenes, i), "swept-on-axis") using "setting":"ns" with linespoints \
         pointtype 7 linecolor rgb colour(i) title word(scenes, i), \
     for [i = 1:words(scenes)] rows(word(scenes, i), "swept-slantwise") using "setting":"ns" with linespoints \
         pointtype 2 linecolor rgb colour(i) notitle
unset multiplot
