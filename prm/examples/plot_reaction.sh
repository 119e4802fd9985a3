#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Draws reaction_NAME.png: the reaction of a boundary condition over its displacement, of a run with load steps.
#
#   prm/examples/plot_reaction.sh DIRECTORY NAME AXIS
#
# DIRECTORY is the run's Output directory, in which the picture is left; NAME the condition's, that of its subsection of
# "Boundary conditions"; AXIS one that it prescribes: x, y or z. Needs gnuplot (Debian: gnuplot-nox).
set -euo pipefail

if [ $# -ne 3 ]; then
  echo "usage: plot_reaction.sh DIRECTORY NAME AXIS" >&2
  exit 1
fi
directory=$1 name=$2 axis=$3
history=$directory/history.csv
picture=$directory/reaction_$name.png
if ! command -v gnuplot >/dev/null; then
  echo "plot_reaction.sh: gnuplot is missing; Debian has it in the package gnuplot-nox" >&2
  exit 1
fi
if [ ! -r "$history" ]; then
  echo "plot_reaction.sh: cannot read $history" >&2
  exit 1
fi
# Commas within quotes, of names that hold some, are none between columns: they are not cut here, only looked for.
for column in "displacement of $name along $axis [m]" "reaction of $name along $axis [N]"; do
  if ! head -n 1 "$history" | grep --quiet --fixed-strings "$column"; then
    echo "plot_reaction.sh: $history has no column \"$column\"" >&2
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
set xlabel "displacement along $axis [mm]"
set ylabel "reaction along $axis [kN]"
plot "$history" using (1e3 * column("displacement of $name along $axis [m]")):\\
  (1e-3 * column("reaction of $name along $axis [N]")) with linespoints linewidth 2 pointtype 7 pointsize 0.5
END
echo "drew $picture"
