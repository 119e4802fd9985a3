#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Draws reaction_NAME.png: the reaction of a boundary condition over its displacement, of a run with load steps, or, where a
# gauge is named, without its sign over the gauge's elongation, such as the opening of a crack's mouth.
#
#   prm/examples/plot_reaction.sh DIRECTORY NAME AXIS [GAUGE]
#
# DIRECTORY is the run's Output directory, in which the picture is left; NAME the condition's, that of its subsection of
# "Boundary conditions"; AXIS that of the reaction, which without a gauge it prescribes: x, y or z; GAUGE the gauge's, that
# of its subsection of "Gauges". Needs gnuplot (Debian: gnuplot-nox).
set -euo pipefail

if [ $# -lt 3 ] || [ $# -gt 4 ]; then
  echo "usage: plot_reaction.sh DIRECTORY NAME AXIS [GAUGE]" >&2
  exit 1
fi
directory=$1 name=$2 axis=$3 gauge=${4:-}
reaction="reaction of $name along $axis [N]"
if [ -n "$gauge" ]; then
  moved="elongation of $gauge [m]" label="elongation of $gauge [mm]" sign=abs
else
  moved="displacement of $name along $axis [m]" label="displacement along $axis [mm]" sign=
fi
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
for column in "$moved" "$reaction"; do
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
set xlabel "$label" noenhanced
set ylabel "reaction along $axis [kN]"
plot "$history" using (1e3 * column("$moved")):\\
  (1e-3 * $sign(column("$reaction"))) with linespoints linewidth 2 pointtype 7 pointsize 0.5
END
echo "drew $picture"
