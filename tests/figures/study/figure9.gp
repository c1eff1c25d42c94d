# Figure 9: scan and remeshes by WSCVT-C, coloured by the largest absolute curvature times R (R: equivalent radius).
load path.'/style.gp'
set terminal pngcairo size 1800,1000 font 'sans,18' background 'white'
set output 'figure9.png'
eval surfaces
load path.'/viridis.gp'
set logscale cb
set cbrange [0.5:10]
set multiplot layout 2,4 title "WSCVT-C, coloured by the largest absolute curvature times R" margins 0.01,0.92,0.02,0.88 spacing 0.005,0.06
do for [grain in 'sand_7228 angular_6000'] {
  do for [mesh in 'scan 500 1000 2000'] {
    set title (mesh eq 'scan' ? grain : 'N = '.mesh) noenhanced
    if (mesh eq '2000') { set colorbox user origin 0.94,0.1 size 0.015,0.7; set cbtics (0.5, 1, 2, 5, 10) } else { unset colorbox }
    splot 'figure9_'.grain.'_'.mesh.'.dat' using 1:2:3:4 with pm3d
  }
}
unset multiplot
