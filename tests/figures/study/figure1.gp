# Figure 1: samplings of the sphere.
load path.'/style.gp'
set terminal svg size 900,900 dynamic font 'sans,13' background 'white'
set output 'figure1.svg'
eval surfaces
set palette defined (0 '#e8eef4', 1 '#e8eef4')
set cbrange [0:2]
set multiplot layout 2,2 margins 0.02,0.98,0.02,0.95 spacing 0.02,0.05
do for [name in 'Fibonacci equal-angle icosahedron WSCVT-D'] {
  set title name
  splot 'figure1_'.name.'.dat' using 1:2:3:4 with pm3d
}
unset multiplot
