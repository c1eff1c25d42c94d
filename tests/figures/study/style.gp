# Shared by the figures. Surfaces are drawn as filled triangles from back to front.
set datafile separator comma
set datafile missing NaN
svg = "set terminal svg size 900,640 dynamic font 'sans,13' background 'white'"
surfaces = "unset border; unset tics; unset key; unset colorbox; set view equal xyz; set view 65,35; set pm3d depthorder border lc rgb '#303030' lw 0.3; set pm3d corners2color mean; set datafile separator whitespace"
