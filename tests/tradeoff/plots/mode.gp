# SPDX-License-Identifier: MIT
# mode.gp - wrong answers per million by scene, how far wrong, and what exactness costs.
set multiplot layout 1,3
set style data histogram
set style fill solid 0.9 noborder
set boxwidth 0.8
set offsets 0.6, 0.6, 0, 0
set rmargin 7
set xtics rotate by -40 scale 0 noenhanced font ",9"
unset key
set key top left inside
set title "Wrong answers per million (no bar: none)"
set yrange [0:*]
plot rows("", "exact") using "wrong_per_million":xtic(1) linecolor rgb colour(1) title "exact: proven 0", \
     rows("", "fast") using "wrong_per_million" linecolor rgb colour(2) title "FAST"
set title "FAST: worst excess of the distance"
set logscale y 2
set yrange [2**-56:2**-49]
set format y "2^{%L}"
set key bottom right
plot rows("", "fast") using (column("worst_excess") > 0 ? column("worst_excess") : 2**-56):xtic(1) \
         with points pointtype 7 pointsize 1.2 linecolor rgb colour(2) title "worst measured (at the foot: 0)", \
     2**-50 with lines linewidth 2 linecolor rgb "black" title "proven: 2^-50"
unset logscale y
set logscale y
set format y "%g"
set yrange [100:*]
set key top right
set title "Nanoseconds a search"
plot rows("", "exact") using "ns":xtic(1) linecolor rgb colour(1) title "exact", \
     rows("", "fast") using "ns" linecolor rgb colour(2) title "FAST"
unset multiplot
