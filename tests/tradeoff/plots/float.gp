# float.gp - what rounding to float does by the distance from the origin.
set multiplot layout 1,3
set key inside top left
set logscale xy
set format xy "10^{%T}"
set xlabel "largest coordinate (a world of side 1000)"
set xrange [500:1e13]
set title "Wrong answers per million (doubles: none)"
set yrange [1:3e6]
plot for [i = 1:words(scenes)] rows(word(scenes, i), "floats") using "setting":"wrong_per_million" with linespoints \
         pointtype mark(i) pointsize 1.3 linecolor rgb colour(i) title word(scenes, i) . ", floats"
set title "Error of the distance"
set yrange [*:*]
plot rows(word(scenes, 1), "floats") using "setting":"bound_error" with lines linewidth 3 linecolor rgb "black" \
         title "proven", \
     for [i = 1:words(scenes)] rows(word(scenes, i), "floats") using "setting":"worst_error" with points \
         pointtype mark(i) pointsize 1.3 linecolor rgb colour(i) title word(scenes, i) . ", worst", \
     for [i = 1:words(scenes)] rows(word(scenes, i), "floats") using "setting":"mean_error" with lines linewidth 0.5 \
         linecolor rgb colour(i) title word(scenes, i) . ", mean"
set title "Points that share a place and had not"
set yrange [0.5:*]
plot for [i = 1:words(scenes)] rows(word(scenes, i), "floats") using "setting":"merged" with linespoints \
         pointtype mark(i) pointsize 1.3 linecolor rgb colour(i) title word(scenes, i)
unset multiplot
