# First contact by nodes, mean over the four samples: bias and scatter against the number of nodes.
set terminal svg size 900,420 font 'sans,12' background 'white'
set output 'contacts.svg'
load path.'/style.gp'
set datafile separator ','
set logscale x
set xrange [90:8000]
set xtics (100, 200, 500, 1000, 2000, 7228)
set xlabel 'nodes'
set key bottom right samplen 2 font ',10'
samplings = '"WSCVT-D" "WSCVT-C" "constant" "Fibonacci" "random" "least squares" "refined" "contact 0.4"'
pick(k, name) = strcol(1) eq "mean" && strcol(2) eq name ? column(k) : NaN
set multiplot layout 1,2
set title 'bias, % of R'
set ylabel 'first contact by nodes less the true one'
plot for [name in samplings] 'contacts.csv' using 3:(pick(4, name)) with linespoints title name, 0 lt -1 notitle
set key bottom left
set title 'scatter, % of R'
set ylabel 'standard deviation'
set logscale y
plot for [name in samplings] 'contacts.csv' using 3:(pick(5, name)) with linespoints title name
unset multiplot
