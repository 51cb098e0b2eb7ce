# SPDX-License-Identifier: MIT
# plot.gp - cost against the number of points, a panel an operation, from what `octree-bench --json` printed:
#   gnuplot -e "results='bench.jsonl'; picture='cost.svg'" tests/bench/plot.gp
# The title of a panel has the exponent e of the octree's cost ~ n^e, fitted to all sets; needs two sizes at least.
if (!exists("results")) results = "bench.jsonl"
if (!exists("picture")) picture = "cost.svg"
ops = "build insert remove move move_far find find_miss box10 box1000 radius100 collide nearest knn8 " \
    . "nearest_batch nearest_all nearest_fast nearest_churned"
sets = "uniform gaussian clustered surface lattice"
peers = "nanoflann boost-packed boost-quadratic boost-rstar"

# "n ns" of the lines of one operation; a set or a tree of "" is any.
rows(op, set, who) = sprintf("< awk -F'[\":,{}]+' -v op=%s -v set=%s -v who=%s " \
    . "'$3 == op && (set == \"\" || $5 == set) && $9 == who {print $7, $11}' '%s' | sort -g", op, set, who, results)
some(op, set, who) = 0 + system(sprintf("%s | wc -l", substr(rows(op, set, who), 3, 1000)))
who_of(curve) = curve[1:strstrt(curve, ":") - 1]
set_of(curve) = curve[strstrt(curve, ":") + 1:]

if (picture[strlen(picture) - 3:] eq ".png") {
    set terminal pngcairo size 1800,1800 font ",11"
} else {
    set terminal svg size 1800,1800 background rgb "white" font ",11"
}
set output picture
set multiplot layout 6,3 title "CPU nanoseconds an operation against the number of points (thick: peers)"
set logscale xy
set format x "10^{%T}"
set key outside right samplen 1 font ",8"
do for [op in ops] {
    if (some(op, "", "octree") < 2) { continue }
    stats rows(op, "", "octree") using (log($1)):(log($2)) name "FIT" nooutput
    set title sprintf("%s: n^%.2f", op, FIT_slope) noenhanced
    curves = ""
    do for [s in sets] { if (some(op, s, "octree")) { curves = curves . " octree:" . s } }
    do for [p in peers] { if (some(op, "uniform", p)) { curves = curves . " " . p . ":uniform" } }
    plot for [c in curves] rows(op, set_of(c), who_of(c)) using 1:2 with linespoints pointsize 0.5 \
             linewidth (who_of(c) eq "octree" ? 1 : 3) title sprintf("%s, %s", who_of(c), set_of(c)) noenhanced, \
         exp(FIT_intercept) * x ** FIT_slope with lines linecolor "black" title "octree, fit"
}
unset multiplot
