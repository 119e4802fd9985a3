#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Draws size_effect.png of a folder with the size_effect.csv that run.py writes: nominal strength over depth, beside
# cohesive cracks and Bazant's law.
#
#   tests/validation/three_point_bending/plot_size_effect.sh DIRECTORY
#
# Needs gnuplot (Debian: gnuplot-nox).
set -euo pipefail

if [ $# -ne 1 ] || [ ! -r "$1/size_effect.csv" ]; then
  echo "usage: plot_size_effect.sh DIRECTORY, with a size_effect.csv in it" >&2
  exit 1
fi
gnuplot <<END
set terminal pngcairo size 800, 550 font ",11"
set output "$1/size_effect.png"
set datafile separator ","
set logscale xy
set grid
set key top right
set xlabel "depth [mm]"
set ylabel "nominal strength 1.5 P S/(b D^2) [MPa]"
set xrange [40:500]
plot "$1/size_effect.csv" using (1e3 * column(1)):(1e-6 * column(2)) skip 1 with points pointtype 7 title "perideal", \\
  "" using (1e3 * column(1)):(1e-6 * column(3)) skip 1 with lines linewidth 2 title "cohesive crack", \\
  "" using (1e3 * column(1)):(1e-6 * column(4)) skip 1 with lines dashtype 2 linewidth 2 title "Bazant's law"
END
echo "drew $1/size_effect.png"
