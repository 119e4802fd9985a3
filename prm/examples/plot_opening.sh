#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Draws opening_NAME_GAUGE.png: the reaction of a boundary condition over the elongation of a gauge, such as the opening of
# a crack's mouth, of a run with load steps.
#
#   prm/examples/plot_opening.sh DIRECTORY NAME AXIS GAUGE
#
# DIRECTORY is the run's Output directory, in which the picture is left; NAME the condition's, that of its subsection of
# "Boundary conditions"; AXIS that of the reaction: x, y or z; GAUGE the gauge's, that of its subsection of "Gauges".
# The reaction is drawn without its sign. Needs gnuplot (Debian: gnuplot-nox).
set -euo pipefail

if [ $# -ne 4 ]; then
  echo "usage: plot_opening.sh DIRECTORY NAME AXIS GAUGE" >&2
  exit 1
fi
directory=$1 name=$2 axis=$3 gauge=$4
history=$directory/history.csv
picture=$directory/opening_${name}_$gauge.png
if ! command -v gnuplot >/dev/null; then
  echo "plot_opening.sh: gnuplot is missing; Debian has it in the package gnuplot-nox" >&2
  exit 1
fi
if [ ! -r "$history" ]; then
  echo "plot_opening.sh: cannot read $history" >&2
  exit 1
fi
# Commas within quotes, of names that hold some, are none between columns: they are not cut here, only looked for.
for column in "reaction of $name along $axis [N]" "elongation of $gauge [m]"; do
  if ! head -n 1 "$history" | grep --quiet --fixed-strings "$column"; then
    echo "plot_opening.sh: $history has no column \"$column\"" >&2
    exit 1
  fi
done

gnuplot <<END
set terminal pngcairo size 800, 550 font ",11"
set output "$picture"
set datafile separator ","
set grid
set key off
set title "$name" noenhanced
set xlabel "elongation of $gauge [mm]" noenhanced
set ylabel "reaction along $axis [kN]"
plot "$history" using (1e3 * column("elongation of $gauge [m]")):\\
  (1e-3 * abs(column("reaction of $name along $axis [N]"))) with linespoints linewidth 2 pointtype 7 pointsize 0.5
END
echo "drew $picture"
