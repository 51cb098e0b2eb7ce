# SPDX-License-Identifier: MIT
# style.gp - what all plots share. `csv`, `png` and `scenes` (names with blanks between) are given.
if (!exists("size_x")) { size_x = 1240 }
if (!exists("size_y")) { size_y = 560 }
set terminal pngcairo size size_x,size_y font ",11" background rgb "#fdfdfc"
set output png
set datafile separator ","
set datafile columnheaders
set grid linecolor rgb "#e3e6ea"
set border 3 linecolor rgb "#5a6675"
set tics nomirror
set key outside right top noenhanced samplen 1.5 font ",9"
set title noenhanced font ",11"
set xlabel noenhanced font ",10"
set ylabel noenhanced
# Colours that survive colour blindness (Okabe and Ito), and two greys; a proven bound is black.
array colours[12] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8a6d00", "#7f3c8d", "#5a6675", \
                     "#a5aa99", "#11847b", "#b3261e"]
colour(i) = colours[(i - 1) % 12 + 1]
mark(i) = 4 + (i - 1) % 10

# The rows of one scene and one variant, with the line of names; "" is any.
rows(scene, variant) = sprintf("< awk -F, -v s='%s' -v v='%s' 'NR == 1 || ((s == \"\" || $1 == s) && " \
    . "(v == \"\" || $2 == v))' '%s'", scene, variant, csv)
