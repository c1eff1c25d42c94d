# Figure 10: error of the roughness Sdq by number of nodes, from the scan and from the fitted
# surface.
load path.'/style.gp'
set terminal svg size 1000,1450 dynamic font 'sans,13' background 'white'
set output 'figure10.svg'
grain = ''
measure = 'sdq'
load path.'/errors.gp'
set ylabel '|error of Sdq| in %'
set yrange [0.3:30]
set multiplot layout 4,2
do for [grain in 'sand_7228 sand_5658 angular_6000 elongated_rough_8000'] {
  do for [from in '8 9'] {
    set title grain.(from eq '8' ? ', from the scan' : ', from the fitted surface') noenhanced
    plot 'errors.csv' using 3:(mine('WSCVT-C', column(int(from)))) with linespoints lw 2 pt 7 ps 0.6 lc rgb '#1b9e77' title 'WSCVT-C', \
         '' using 3:(mine('constant', column(int(from)))) with linespoints lw 2 pt 5 ps 0.6 lc rgb '#7570b3' title 'constant', \
         '' using 3:(mine('Fibonacci', column(int(from)))) with linespoints lw 2 pt 9 ps 0.6 lc rgb '#d95f02' title 'Fibonacci'
  }
}
unset multiplot
