# Draws a figure of the study in the folder of its data: gnuplot -e "figure='8'" figures.gp

set datafile separator comma
set datafile missing NaN
# Surfaces are drawn as filled triangles from back to front.
surfaces = "unset border; unset tics; unset key; unset colorbox; set view equal xyz; set view 65,35; set pm3d depthorder border lc rgb '#303030' lw 0.3; set pm3d corners2color mean; set datafile separator whitespace"
svg(size) = "set terminal svg size ".size." dynamic font 'sans,13' background 'white'; set output 'figure".figure.".svg'"

# Errors against N, one panel: `value` is the column 8 from the scan, 9 from the fitted surface.
grain = 'sand_7228'
measure = 'sdq'
error(sampling, value) = strcol(1) eq grain && strcol(2) eq sampling && strcol(4) eq measure ? value : NaN
errors = "set logscale xy; set key bottom left; set grid lc rgb '#dddddd'; set xtics (100, 200, 300, 500, 1000, 2000); set xrange [85:2350]; set xlabel 'nodes'"

# Samplings of the sphere.
if (figure eq '1') {
  eval svg('900,900')
  eval surfaces
  set palette defined (0 '#e8eef4', 1 '#e8eef4')
  set cbrange [0:2]
  set multiplot layout 2,2 margins 0.02,0.98,0.02,0.95 spacing 0.02,0.05
  do for [name in 'Fibonacci equal-angle icosahedron WSCVT-D'] {
    set title name
    splot 'figure1_'.name.'.dat' using 1:2:3:4 with pm3d
  }
}

# Scan and remeshes by WSCVT-D, coloured by radius / R (R: equivalent radius), and by WSCVT-C, coloured by
# the largest absolute curvature times R.
if (figure eq '6' || figure eq '9') {
  set terminal pngcairo size 1800,1000 font 'sans,18' background 'white'
  set output 'figure'.figure.'.png'
  eval surfaces
  # Viridis, the perceptually even palette of matplotlib (CC0), at nine places.
  set palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', \
    5 '#28ae80', 6 '#5ec962', 7 '#addc30', 8 '#fde725')
  coloured = figure eq '6' ? 'WSCVT-D, coloured by radius / R' : 'WSCVT-C, coloured by the largest absolute curvature times R'
  if (figure eq '6') { set cbrange [0.7:1.4] } else { set logscale cb; set cbrange [0.5:10] }
  set multiplot layout 2,4 title coloured margins 0.01,0.92,0.02,0.88 spacing 0.005,0.06
  do for [grain in 'sand_7228 angular_6000'] {
    do for [mesh in 'scan 500 1000 2000'] {
      set title (mesh eq 'scan' ? grain : 'N = '.mesh) noenhanced
      if (mesh eq '2000') {
        set colorbox user origin 0.94,0.1 size 0.015,0.7
        if (figure eq '6') { set cbtics } else { set cbtics (0.5, 1, 2, 5, 10) }
      } else {
        unset colorbox
      }
      splot 'figure'.figure.'_'.grain.'_'.mesh.'.dat' using 1:2:3:4 with pm3d
    }
  }
}

# Edge length / mean and edge ratio, scan and remesh with as many nodes.
if (figure eq '7') {
  eval svg('900,640')
  set style fill transparent solid 0.5 noborder
  set grid ytics lc rgb '#dddddd'
  set ylabel 'share in %'
  share(column) = strcol(1) eq grain && strcol(2) eq measure ? 100 * column : NaN
  set multiplot layout 2,2
  do for [grain in 'sand_7228 sand_5658'] {
    do for [measure in 'edge_length edge_ratio'] {
      set title grain noenhanced
      set xlabel (measure eq 'edge_length' ? 'edge length / mean' : 'longest / shortest edge of a triangle (last bar: above)')
      set xrange [(measure eq 'edge_length' ? 0 : 1):(measure eq 'edge_length' ? 2 : 3)]
      set yrange [0:*]
      plot 'figure7.csv' using 3:(share($5)):4 with boxes lc rgb '#d95f02' title 'scan', \
           '' using 3:(share($6)):4 with boxes lc rgb '#1b9e77' title 'WSCVT-D'
    }
  }
}

# Errors against the scan by number of nodes, and those that the paper prints.
if (figure eq '8') {
  eval svg('1000,760')
  eval errors
  set ylabel '|error| in %'
  set multiplot layout 2,2 title grain.', against the scan, mean over the poses' noenhanced
  do for [measure in 'volume area aspect_ratio sphericity'] {
    set title (measure eq 'aspect_ratio' ? 'aspect ratio (inertia ellipsoid)' : measure)
    plot 'errors.csv' using 3:(error('WSCVT-D', $8)) with linespoints lw 2 pt 7 ps 0.6 lc rgb '#1b9e77' title 'WSCVT-D', \
         '' using 3:(error('constant', $8)) with linespoints lw 2 pt 5 ps 0.6 lc rgb '#7570b3' title 'constant', \
         '' using 3:(error('Fibonacci', $8)) with linespoints lw 2 pt 9 ps 0.6 lc rgb '#d95f02' title 'Fibonacci', \
         '' using 3:(error('WSCVT-D', $10)) with points pt 4 ps 1.1 lw 2 lc rgb 'black' title "paper's WSCVT-D"
  }
}

# Error of the roughness Sdq by number of nodes, from the scan and from the fitted surface.
if (figure eq '10') {
  eval svg('1000,1450')
  eval errors
  set ylabel '|error of Sdq| in %'
  set yrange [0.3:30]
  set multiplot layout 4,2
  do for [grain in 'sand_7228 sand_5658 angular_6000 elongated_rough_8000'] {
    do for [from in '8 9'] {
      set title grain.(from eq '8' ? ', from the scan' : ', from the fitted surface') noenhanced
      plot 'errors.csv' using 3:(error('WSCVT-C', column(int(from)))) with linespoints lw 2 pt 7 ps 0.6 lc rgb '#1b9e77' title 'WSCVT-C', \
           '' using 3:(error('constant', column(int(from)))) with linespoints lw 2 pt 5 ps 0.6 lc rgb '#7570b3' title 'constant', \
           '' using 3:(error('Fibonacci', column(int(from)))) with linespoints lw 2 pt 9 ps 0.6 lc rgb '#d95f02' title 'Fibonacci'
    }
  }
}

# First contact by nodes, mean over the four samples: bias and scatter against the number of nodes.
if (figure eq 'contacts') {
  set terminal svg size 900,420 font 'sans,12' background 'white'
  set output 'contacts.svg'
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
}

# Energies in Yade against time, for the choices of nodes: means over the starts with their intervals of 95 %.
if (figure eq 'packing') {
  set terminal svg size 1200,420 font 'sans,12' background 'white'
  set output 'packing.svg'
  choices = system("tail -n +2 energies.csv | cut -d, -f1 | uniq")
  pick(k, name) = strcol(1) eq name ? column(k) : NaN
  end(k, sign, name) = pick(k, name) + sign * column(k + 3)
  set xlabel 'time, s'
  set xtics 0.2
  set key top right samplen 2 font ',10' noenhanced
  set style fill transparent solid 0.15 noborder
  set multiplot layout 1,3
  do for [k=3:5] {
    set title word('kinetic potential elastic', k - 2).' energy, J'
    plot for [i=1:words(choices)] 'energies.csv' using 2:(end(k, -1, word(choices, i))):(end(k, 1, word(choices, i))) with filledcurves lc i notitle, \
      for [i=1:words(choices)] '' using 2:(pick(k, word(choices, i))) with lines lc i title word(choices, i)
    unset key
  }
}
