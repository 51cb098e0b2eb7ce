# SPDX-License-Identifier: MIT
# leaf.gp - time and memory by leaf capacity, with what AUTO chose; and time by the greatest depth.
set multiplot layout 1,3
set key inside top right
set logscale x 2
set xlabel "leaf capacity (diamonds: AUTO; grey: the default)"
set xrange [0.8:320]
set yrange [0:*]
set title "Nanoseconds an operation (default mix)"
set arrow 1 from 64, graph 0 to 64, graph 1 nohead linecolor rgb "#a5aa99" linewidth 2
plot for [i = 1:words(scenes)] "< awk -F, -v s=" . word(scenes, i) . " 'NR == 1 {print; next} $1 == s && " \
         . "$2 == \"capacity\" {print | \"sort -t, -k3,3g\"}' '" . csv . "'" using "setting":"mix_ns" with linespoints \
         pointtype 7 pointsize 0.7 linecolor rgb colour(i) title word(scenes, i), \
     for [i = 1:words(scenes)] rows(word(scenes, i), "auto") using "setting":"mix_ns" with points pointtype 13 \
         pointsize 2.2 linecolor rgb colour(i) notitle
set title "Bytes a point"
plot for [i = 1:words(scenes)] "< awk -F, -v s=" . word(scenes, i) . " 'NR == 1 {print; next} $1 == s && " \
         . "$2 == \"capacity\" {print | \"sort -t, -k3,3g\"}' '" . csv . "'" using "setting":"bytes" with linespoints \
         pointtype 7 pointsize 0.7 linecolor rgb colour(i) title word(scenes, i), \
     32 with lines linecolor rgb "black" title "the points themselves"
unset arrow 1
unset logscale x
set key top right
set logscale y
set xlabel "greatest depth, capacity 64 (default: 21)"
set xrange [3:22]
set yrange [100:3000]
set title "Nanoseconds an operation (default mix)"
plot for [i = 1:words(scenes)] rows(word(scenes, i), "depth") using "setting":"mix_ns" with linespoints pointtype 7 \
         linecolor rgb colour(i) title word(scenes, i)
unset multiplot
