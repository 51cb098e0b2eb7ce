# SPDX-License-Identifier: MIT
# png.gp - bytes against time of the encoder, by way of storing and level.
set multiplot layout 1,words(scenes)
ways = "indexed-rle indexed rgb rgb-adaptive"
set logscale xy 2
set key inside top right
set xlabel "milliseconds (labels: level; square: default)"
do for [s = 1:words(scenes)] {
    set title word(scenes, s)
    set ylabel (s == 1 ? "kilobytes" : "")
    plot for [i = 1:words(ways)] rows(word(scenes, s), word(ways, i)) using "ms":(column("bytes") / 1000) \
             with linespoints pointtype 7 linecolor rgb colour(i) title word(ways, i), \
         for [i = 1:words(ways)] rows(word(scenes, s), word(ways, i)) \
             using "ms":(column("bytes") / 1000):(strcol("setting")) with labels offset 0.6, 0.6 font ",8" notitle, \
         rows(word(scenes, s), "indexed-rle") using "ms":(column("setting") == 1 ? column("bytes") / 1000 : NaN) \
             with points pointtype 4 pointsize 2.5 linewidth 2 linecolor rgb "black" notitle
}
unset multiplot
