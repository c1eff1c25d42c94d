# Figure 7: edge length / mean and edge ratio, scan and remesh with as many nodes.
load path.'/style.gp'
eval svg
set output 'figure7.svg'
set style fill transparent solid 0.5 noborder
set grid ytics lc rgb '#dddddd'
set ylabel 'share in %'
set multiplot layout 2,2
do for [grain in 'sand_7228 sand_5658'] {
  do for [measure in 'edge_length edge_ratio'] {
    set title grain noenhanced
    set xlabel (measure eq 'edge_length' ? 'edge length / mean' : 'longest / shortest edge of a triangle (last bar: above)')
    set xrange [(measure eq 'edge_length' ? 0 : 1):(measure eq 'edge_length' ? 2 : 3)]
    set yrange [0:*]
    mine(column) = strcol(1) eq grain && strcol(2) eq measure ? 100 * column : NaN
    plot 'figure7.csv' using 3:(mine($5)):4 with boxes lc rgb '#d95f02' title 'scan', \
         '' using 3:(mine($6)):4 with boxes lc rgb '#1b9e77' title 'WSCVT-D'
  }
}
unset multiplot
