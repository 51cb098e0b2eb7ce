# SPDX-License-Identifier: MIT
# tick.gp - one flight in more and more ticks: who flies past, how far the stop is off, and what it takes.
set multiplot layout 1,3
set key inside top right
set logscale x 2
set xlabel "ticks of the flight"
set xrange [0.8:80]
set title "Flights past what was in the way, %"
set yrange [-2:115]
plot rows("", "ends") using "setting":(100 * column("flown_past") / column("flights")) with linespoints pointtype 5 \
         linecolor rgb colour(2) title "ends of a tick: nothing proven", \
     0 with lines linewidth 3 linecolor rgb "black" title "swept: proven", \
     rows("", "swept") using "setting":(100 * column("flown_past") / column("flights")) with points pointtype 7 \
         linecolor rgb colour(1) title "swept: measured"
set title "Stop to true stop / length of the flight"
set logscale y 2
set yrange [*:4]
set format y "2^{%L}"
plot rows("", "swept") using "setting":"bound_error" with lines linewidth 3 linecolor rgb "black" \
         title "swept, proven: a step", \
     rows("", "swept") using "setting":"worst_error" with points pointtype 7 linecolor rgb colour(1) \
         title "swept, worst", \
     rows("", "swept") using "setting":"mean_error" with lines linewidth 0.5 linecolor rgb colour(1) \
         title "swept, mean", \
     rows("", "ends") using "setting":"worst_error" with points pointtype 5 linecolor rgb colour(2) \
         title "ends, worst", \
     rows("", "ends") using "setting":"mean_error" with lines linewidth 0.5 linecolor rgb colour(2) title "ends, mean"
set title "Milliseconds a flight, 1200 points that move"
set format y "%g"
set yrange [*:*]
set key top left
plot rows("", "ends") using "setting":(column("ns") / 1e6) with linespoints pointtype 5 linecolor rgb colour(2) \
         title "ends", \
     rows("", "swept") using "setting":(column("ns") / 1e6) with linespoints pointtype 7 linecolor rgb colour(1) \
         title "swept"
unset multiplot
