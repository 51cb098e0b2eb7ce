# SPDX-License-Identifier: MIT
# shade.gp - what an error of depth or place costs, and what is seen of leaves against time.
set multiplot layout 1,2
set title "what points that are off cost"
set xlabel "off by up to ... pixels"
set ylabel "levels of 255"
set logscale x 2
plot for [s = 1:words(scenes)] rows(word(scenes, s), "depth") using "setting":"mean_levels" \
         with linespoints pointtype 7 linecolor rgb colour(s) title word(scenes, s)." depth, mean", \
     for [s = 1:words(scenes)] rows(word(scenes, s), "depth") using "setting":"worst_levels" \
         with linespoints pointtype 6 dashtype 2 linecolor rgb colour(s) title word(scenes, s)." depth, worst", \
     for [s = 1:words(scenes)] rows(word(scenes, s), "place") using "setting":"mean_levels" \
         with linespoints pointtype 5 linecolor rgb colour(s + 4) title word(scenes, s)." place, mean", \
     rows(word(scenes, 1), "depth") using "setting":"bound_levels" with lines linewidth 2 linecolor rgb "black" title "proven"
unset logscale x
ways = "plain height leaf boxes"
set title word(scenes, words(scenes))
set xlabel "milliseconds a frame"
set ylabel "% of leaf boundaries seen (hollow: seen where there is none)"
set yrange [0:100]
plot for [i = 1:words(ways)] rows(word(scenes, words(scenes)), word(ways, i)) using "ms":"seen" \
         with points pointtype 7 pointsize 2 linecolor rgb colour(i) title word(ways, i), \
     for [i = 1:words(ways)] rows(word(scenes, words(scenes)), word(ways, i)) using "ms":"false" \
         with points pointtype 6 pointsize 2 linecolor rgb colour(i) notitle
unset multiplot
