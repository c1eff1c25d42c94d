# Energies of 54 grains in Yade against time, means over the starts, for the choices of nodes.
set terminal svg size 1200,420 font 'sans,12' background 'white'
set output 'packing.svg'
load path.'/style.gp'
choices = '"scan_7228" "scan_100" "scan_500" "scan_1000" "least-squares_100" "least-squares_200" "contact_200"'
pick(k, name) = strcol(1) eq name ? column(k) : NaN
set xlabel 'time, s'
set key top right samplen 2 font ',10' noenhanced
set multiplot layout 1,3
set title 'kinetic energy, J'
plot for [name in choices] 'energies.csv' using 2:(pick(3, name)) with lines title name
unset key
set title 'potential energy, J'
plot for [name in choices] 'energies.csv' using 2:(pick(4, name)) with lines
set title 'elastic energy, J'
plot for [name in choices] 'energies.csv' using 2:(pick(5, name)) with lines
unset multiplot
