#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Draws tension_column_damping.png: kinetic and strain energy of the damped column over the steps (QUAD, figures 3.20-3.22).
#
#   prm/examples/plot_tension_column_damping.sh [PROGRAM] [PICTURE]
#
# PROGRAM is build/perideal unless given, PICTURE in the current folder. Needs gnuplot (Debian: gnuplot-nox).
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=${1:-$here/../../build/perideal}
picture=${2:-tension_column_damping.png}
if ! command -v gnuplot >/dev/null; then
  echo "plot_tension_column_damping.sh: gnuplot is missing; Debian has it in the package gnuplot-nox" >&2
  exit 1
fi
runs=$(mktemp -d)
trap 'rm -r "$runs"' EXIT

# run NAME OVERRIDE: leaves history.csv in the folder NAME.
run()
{
  OMP_NUM_THREADS=1 "$program" "$here/tension_column_damping.prm" --set "Output directory=$runs/$1" \
    --set "Solver/Damping=0" --set "$2" >/dev/null
}
run undamped "Solver/Damping=0"
run absolute_5e4 "Solver/Damping=5e4"
run absolute_1e5 "Solver/Damping=1e5"
run relative_5e4 "Solver/Relative damping=5e4"

gnuplot <<END
set terminal pngcairo size 1100, 800 font ",11"
set output "$picture"
set datafile separator ","
set multiplot layout 2, 2
set xlabel "step"
set ylabel "energy [J]"
set xrange [0:60]
do for [name in "undamped absolute_5e4 absolute_1e5 relative_5e4"] {
  set title name noenhanced
  plot "$runs/".name."/history.csv" using "step":"kinetic energy [J]" with lines title "kinetic", \\
       "" using "step":"strain energy [J]" with lines title "strain"
}
END
echo "drew $picture"
