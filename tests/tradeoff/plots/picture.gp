# SPDX-License-Identifier: MIT
# picture.gp - nearness to the picture with 16 x 16 samples and nothing left out, against time and primitives.
set multiplot layout 1,3
set key inside bottom right
set logscale x 2
set xlabel "milliseconds a frame (labels: at --lod 2)"
set ylabel "PSNR, decibels"
set title "What a frame is worth, and what it takes"
set offsets graph 0.1, graph 0.1, graph 0.05, graph 0.05
plot for [i = 1:words(scenes)] rows(word(scenes, i), "") using "ms":"psnr" with points pointtype mark(i) \
         linecolor rgb colour(i) title word(scenes, i), \
     for [i = 1:words(scenes)] rows(word(scenes, i), "") \
         using "ms":"psnr":(column("setting") == 2 ? strcol("variant") : "") with labels offset 0, 0.8 font ",8" notitle
unset logscale x
unset offsets
set key top left
set xlabel "--lod, pixels"
set ylabel ""
set title "Largest box left out, pixels"
set xrange [0:8.5]
set yrange [0:10]
plot x with lines linewidth 3 linecolor rgb "black" title "proven: lod", \
     for [i = 1:words(scenes)] rows(word(scenes, i), "aa1") using "setting":"largest_left_out" with points \
         pointtype mark(i) pointsize 1.4 linecolor rgb colour(i) title word(scenes, i)
set title "Primitives drawn"
set logscale y
set yrange [100:*]
set key top right
plot for [i = 1:words(scenes)] rows(word(scenes, i), "aa1") using "setting":"quads" with linespoints \
         pointtype mark(i) linecolor rgb colour(i) title word(scenes, i)
unset multiplot
