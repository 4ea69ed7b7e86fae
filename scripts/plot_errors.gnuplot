# Histograms of errors from docs/figures/{error,ulp}_octaves.csv: gnuplot scripts/plot_errors.gnuplot
# The data: SCOTOPIC_HISTOGRAM and SCOTOPIC_HISTOGRAM_ULP, see tests/properties.
set datafile separator ","
set terminal svg size 800,420 background "white"
set grid
set key outside right top
set style data histeps
set output "docs/figures/error_octaves.svg"
set title "Relative error of whole pixels, every regime (docs/hard-cases.md)"
set xlabel "log2 of the error over the pixel's largest component (-60: that or exact)"
set ylabel "pixels"
set logscale y
set format y "10^{%L}"
set xrange [-61:-14]
plot "docs/figures/error_octaves.csv" using 1:($2+0.5) title "double (reference)" lw 2, \
     "" using 1:($3+0.5) title "float" lw 2, "" using 1:($4+0.5) title "double inside, float out" lw 2
set output "docs/figures/ulp_octaves.svg"
set title "Functions of one variable against extended precision"
set xlabel "log2 of the error in ulp (-16: that or exact)"
set ylabel "share of the floats tried"
set xrange [-17:6]
set yrange [1e-7:2]
functions = "gain_double gain_float mesopic_coefficient mesopic_share_float mesopic_share_dual pupil_diameter trolands \
chroma_factor_double chroma_factor_float acuity_cutoff lab_lightness acuity_lab_f_float acuity_lab_f_inverse_float"
plot for [i=1:words(functions)] "docs/figures/ulp_octaves.csv" \
     using (strcol(1) eq word(functions, i) ? $2 : NaN):($3 > 0 ? $3 : 1e-8) title word(functions, i) noenhanced \
     linecolor 1 + (i - 1) % 8 dashtype 1 + (i - 1) / 8 linewidth 2
