# Errors against N, one panel: needs grain, measure and the column (8 from the scan, 9 from the
# fitted surface).
mine(sampling, value) = strcol(1) eq grain && strcol(2) eq sampling && strcol(4) eq measure ? value : NaN
set logscale xy
set key bottom left
set grid lc rgb '#dddddd'
set xtics (100, 200, 300, 500, 1000, 2000)
set xrange [85:2350]
set xlabel 'nodes'
