# Figure 8: errors against the scan by number of nodes, and those that the paper prints.
load path.'/style.gp'
set terminal svg size 1000,760 dynamic font 'sans,13' background 'white'
set output 'figure8.svg'
grain = 'sand_7228'
measure = ''
load path.'/errors.gp'
set ylabel '|error| in %'
set multiplot layout 2,2 title grain.', against the scan, mean over the poses' noenhanced
do for [measure in 'volume area aspect_ratio sphericity'] {
  set title (measure eq 'aspect_ratio' ? 'aspect ratio (inertia ellipsoid)' : measure)
  plot 'errors.csv' using 3:(mine('WSCVT-D', $8)) with linespoints lw 2 pt 7 ps 0.6 lc rgb '#1b9e77' title 'WSCVT-D', \
       '' using 3:(mine('constant', $8)) with linespoints lw 2 pt 5 ps 0.6 lc rgb '#7570b3' title 'constant', \
       '' using 3:(mine('Fibonacci', $8)) with linespoints lw 2 pt 9 ps 0.6 lc rgb '#d95f02' title 'Fibonacci', \
       '' using 3:(mine('WSCVT-D', $10)) with points pt 4 ps 1.1 lw 2 lc rgb 'black' title "paper's WSCVT-D"
}
unset multiplot
