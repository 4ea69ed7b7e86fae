# The luminance histogram of a scene, an octave a bar, with what the eye is adapted to.
#   scotopic explain night.exr --white-luminance 10 --csv > light.csv
#   gnuplot -c scripts/plot/luminance.gnuplot light.csv light.svg 0.1
set datafile separator ","
set datafile columnheaders
set terminal svg size 720,300 font "sans-serif,11" background "white"
set output ARG2
set logscale x
set format x "10^{%L}"
set xlabel "luminance, cd/m^2, an octave a bar"
set ylabel "% of pixels"
set yrange [0:*]
set key outside bottom center horizontal
# CIE 191:2010: mesopic from 0.005 to 5 cd/m2.
set object rectangle from first 0.005, graph 0 to first 5, graph 1 fillcolor "#dde4f5" fillstyle solid noborder behind
set style fill solid 0.9
if (ARGC > 2) set arrow from first real(ARG3), graph 0 to first real(ARG3), graph 1 nohead linewidth 2 linecolor "#c03030" front
plot ARG1 using (sqrt($1 * $2)):($1 > 0 ? 100 * $3 : NaN):1:2:(0):(100 * $3) with boxxyerror linecolor "#405080" title "share of pixels", \
     NaN with lines linewidth 2 linecolor "#c03030" title (ARGC > 2 ? "adapted to ".ARG3." cd/m^2" : "")
