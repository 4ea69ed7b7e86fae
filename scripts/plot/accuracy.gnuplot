# Greatest error against time of the operator's evaluators; filled: no other is both faster and more accurate.
#   scotopic time --csv > time.csv
#   gnuplot -c scripts/plot/accuracy.gnuplot time.csv accuracy.svg "processor; OpenColorIO 2.1"
set datafile separator ","
set datafile columnheaders
set terminal svg size 720,440 font "sans-serif,13" background "white"
set output ARG2
set logscale xy
set grid
set rmargin 14
set format "10^{%L}"
set xlabel "nanoseconds per pixel".(ARGC > 2 ? "\n{/=10 ".ARG3."}" : "")
set ylabel "greatest CIEDE2000"
set title "Pixels exposed to Y = 0.184" font ",11"
unset key
# Columns: group, name, ns, ..., 10: greatest CIEDE2000, ..., 19: whether another is better in both.
of(better) = strcol(1) eq "operator" && column(10) > 0 && column(19) == better
plot ARG1 using (of(0) ? $3 : NaN):10 with points pointtype 7 pointsize 0.8 linecolor "#003366", \
     "" using (of(1) ? $3 : NaN):10 with points pointtype 6 pointsize 0.8 linecolor "#003366", \
     "" using (of(0) || of(1) ? $3 : NaN):10:2 with labels left offset 0.8,0 noenhanced
