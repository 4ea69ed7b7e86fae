# The adaptation luminance of a sequence over its frames; a red line where what a frame calls for changes.
#   scotopic explain in.####.exr --frames 1-240 --white-luminance 10 --csv > shot.csv
#   gnuplot -c scripts/plot/adaptation.gnuplot shot.csv shot.svg
set datafile separator ","
set datafile columnheaders
stats ARG1 using 1 name "frame" nooutput
stats ARG1 using 2 name "light" nooutput
set terminal svg size 720,320 font "sans-serif,11" background "white"
set output ARG2
set logscale y
# Whole decades, so that there are at least two numbers at the axis.
set yrange [10**floor(log10(0.999 * light_min)) : 10**ceil(log10(1.001 * light_max))]
set xrange [frame_min - 0.5 : frame_max + 0.5]
set xtics ceil((frame_max - frame_min + 1) / 12.0)
set grid ytics
set format y "%g"
set xlabel "frame"
set ylabel "adaptation luminance, cd/m^2"
set key outside bottom center horizontal
# CIE 191:2010: mesopic from 0.005 to 5 cd/m2.
set object rectangle from graph 0, first 0.005 to graph 1, first 5 fillcolor "#dde4f5" fillstyle solid noborder behind
# The effects of the row before.
before = ""
change(effects) = (other = before ne "" && effects ne before, before = effects, other)
plot ARG1 using (change(strcol(4)) ? $1 : NaN):2 with impulses linecolor "#c03030" title "the plan changes", \
     light_median with lines dashtype 2 linecolor "#405080" title "the shot's median", \
     ARG1 using 1:2 with linespoints pointtype 7 pointsize 0.4 linewidth 2 linecolor "#405080" title "each frame"
