# SPDX-License-Identifier: MIT
# float.gp - what rounding to float does by the distance from the origin.
set multiplot layout 1,3
set key inside top left
set logscale xy
set format xy "10^{%T}"
set xlabel "largest coordinate (a world of side 1000)"
set xrange [8:1e13]
set title "Wrong answers per million (doubles: none)"
set yrange [1:3e6]
at_foot(value, foot) = value > foot ? value : foot
set label 1 "at the foot: 0" at graph 0.98, graph 0.03 right font ",9"
plot for [i = 1:words(scenes)] rows(word(scenes, i), "floats") \
         using "setting":(at_foot(column("wrong_per_million"), 1)) with linespoints \
         pointtype mark(i) pointsize 1.3 linecolor rgb colour(i) title word(scenes, i) . ", floats"
set title "Error of the distance"
set yrange [1e-6:1e6]
plot rows("", "floats") using "setting":"bound_error" smooth unique with lines linewidth 3 linecolor rgb "black" \
         title "proven", \
     for [i = 1:words(scenes)] rows(word(scenes, i), "floats") using "setting":(at_foot(column("worst_error"), 1e-6)) \
         with points pointtype mark(i) pointsize 1.3 linecolor rgb colour(i) title word(scenes, i) . ", worst", \
     for [i = 1:words(scenes)] rows(word(scenes, i), "floats") using "setting":(at_foot(column("mean_error"), 1e-6)) \
         with lines linewidth 0.5 linecolor rgb colour(i) title word(scenes, i) . ", mean"
set title "Points that share a place and had not"
set yrange [0.5:*]
plot for [i = 1:words(scenes)] rows(word(scenes, i), "floats") \
         using "setting":(at_foot(column("merged"), 0.5)) with linespoints \
         pointtype mark(i) pointsize 1.3 linecolor rgb colour(i) title word(scenes, i)
unset multiplot
