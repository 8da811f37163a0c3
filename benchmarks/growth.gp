# What `growth` measured: rays a second, seconds of building and memory.
#   gnuplot -c growth.gp growth.csv growth.svg
set datafile separator ','
set datafile columnheaders
set datafile missing NaN
set terminal svg size 1350,480 background rgb 'white'
set output ARG2
set multiplot layout 1,3
set logscale x
set xrange [9e3:*]
set format x '%.0s%c'
set xlabel 'triangles of the forest'
set grid
set style data linespoints
set key noenhanced below maxcols 3

accelerators = 'bvh embree light_grid'
# The medians of the rows of one light and one accelerator.
median(light, accelerator, figure) = \
    strstrt(stringcolumn('name'), '/' . light . '/') > 0 && \
    strstrt(stringcolumn('name'), '/' . accelerator . '_median') > 0 ? column(figure) : NaN

set title 'Millions of rays a second, one thread'
set yrange [0:*]
plot for [i=1:3] ARG1 using 'triangles':(1e-6 * median('bulb', word(accelerators, i), 'items_per_second')) \
         title word(accelerators, i) . ', bulb' lt i dt 1, \
     for [i=1:3] ARG1 using 'triangles':(1e-6 * median('sun', word(accelerators, i), 'items_per_second')) \
         title word(accelerators, i) . ', sun' lt i dt 2

set title 'Seconds of building'
set logscale y
set yrange [*:*]
plot for [i=1:3] ARG1 using 'triangles':(median('bulb', word(accelerators, i), 'build_seconds')) \
         title word(accelerators, i) lt i

set title 'Bytes a triangle'
unset logscale y
set yrange [0:*]
plot for [i=1:3] ARG1 using 'triangles':(median('bulb', word(accelerators, i), 'bytes_per_triangle')) \
         title word(accelerators, i) lt i
