#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Draws plate_with_hole.png: displacement along the hole, three models and Q1 finite elements beside the reference.
#
#   prm/examples/plot_plate_with_hole.sh [PROGRAM] [PICTURE]
#
# PROGRAM is build/perideal unless given, PICTURE the one beside this script. Needs gnuplot (Debian: gnuplot-nox).
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=${1:-$here/../../build/perideal}
picture=${2:-$here/plate_with_hole.png}
if ! command -v gnuplot >/dev/null; then
  echo "plot_plate_with_hole.sh: gnuplot is missing; Debian has it in the package gnuplot-nox" >&2
  exit 1
fi
profiles=$(mktemp -d)
trap 'rm -r "$profiles"' EXIT

# run NAME OVERRIDES...: leaves profile_hole.csv in the folder NAME.
run()
{
  local name=$1 override settings=()
  shift
  for override in "$@" "Output directory=$profiles/$name"; do
    settings+=(--set "$override")
  done
  OMP_NUM_THREADS=1 "$program" "$here/plate_with_hole.prm" "${settings[@]}" >/dev/null
}
mirror="Boundary conditions/Displacement treatment=mirror"
run energy "Material/Form=energy" "$mirror"
run paper "Material/Form=paper" "$mirror" "Comparison/Reference=false"
run ordinary "Material/Model=ordinary" "$mirror" "Comparison/Reference=false"

# Columns of a profile: angle, x, y, u_x, u_y, then the same two of Q1 finite elements and of the reference.
# One quarter is drawn; the others mirror it. Points only at every third node, so that lines stay visible.
gnuplot <<PLOT
set terminal pngcairo size 1200,480 font "DejaVu Sans,12" background "white"
set output "$picture"
set datafile separator ","
set multiplot layout 1,2 margins 0.065,0.985,0.13,0.92 spacing 0.085
set xrange [0:90]
set xtics 15
set grid xtics ytics linetype 1 linewidth 0.5 linecolor rgb "#cccccc"
set xlabel "angle along the hole [degrees]"
set key left bottom Left reverse samplen 2.5 spacing 1.15
um = 1e6
energy = "$profiles/energy/profile_hole.csv"
paper = "$profiles/paper/profile_hole.csv"
ordinary = "$profiles/ordinary/profile_hole.csv"
do for [component = 1:2] {
  set title (component == 1 ? "along the pull" : "across the pull")
  if (component == 2) { set key off }
  set ylabel (component == 1 ? "u_x [µm]" : "u_y [µm]") offset 0.5,0 noenhanced
  plot energy skip 1 using 1:(um * column(7 + component)) with lines linewidth 5 linecolor rgb "#c8c8c8" \
         title "reference", \
       ordinary skip 1 using 1:(um * column(3 + component)) with lines linewidth 2 linecolor rgb "#d55e00" \
         title "ordinary", \
       paper skip 1 using 1:(um * column(3 + component)) with lines linewidth 2 linecolor rgb "#0072b2" \
         title "extended, paper form", \
       energy skip 1 every 3 using 1:(um * column(3 + component)) with points pointtype 6 pointsize 1 \
         linewidth 1.5 linecolor rgb "#009e73" title "extended, energy form", \
       energy skip 1 every 3::1 using 1:(um * column(5 + component)) with points pointtype 2 pointsize 0.8 \
         linewidth 1.5 linecolor rgb "black" title "Q1 finite elements"
}
unset multiplot
PLOT
echo "$picture"
