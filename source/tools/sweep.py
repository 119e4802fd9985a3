#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws the table of a parameter sweep, sweep.csv of DIRECTORY, to sweep.svg there: errors over the number of nodes,
or, where nothing was compared, the strain energy over the parameter.

    sweep.py DIRECTORY

Prints the name of the file. Exit status as of plot.py.
"""

import csv
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def read_table(path):
    """(header, rows) of texts."""
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    return header, rows


def series(header, rows, abscissa, ordinate, others):
    """{label: [(x, y)]} of two columns, a series for each combination of the other columns."""
    result = {}
    for row in rows:
        x, y = number(row[header.index(abscissa)]), number(row[header.index(ordinate)])
        label = ", ".join(row[header.index(column)] for column in others)
        if x is not None and y is not None:
            result.setdefault(label, []).append((x, y))
    return result


def changes_nodes(header, rows, k):
    """Whether the number of nodes depends on the k-th parameter."""
    nodes_of = {}
    for row in rows:
        others = tuple(row[:k] + row[k + 1 : header.index("status")])
        nodes_of.setdefault(others, set()).add(row[header.index("nodes")])
    return any(len(nodes) > 1 for nodes in nodes_of.values())


def error_curves(header, rows):
    """[(label, points)] of all errors over the nodes: a curve for each value of what does not change the nodes."""
    fixed = [column for k, column in enumerate(header[: header.index("status")]) if not changes_nodes(header, rows, k)]
    curves = []
    for column in header:
        if column.startswith("error against "):
            for label, points in series(header, rows, "nodes", column, fixed).items():
                name = column[len("error ") : -len(" [-]")]
                curves.append((f"{label}, {name}" if label else name, sorted(point for point in points if point[1] > 0)))
    return [curve for curve in curves if curve[1]]


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    directory = Path(sys.argv[-1])
    try:
        from curves import rcParams  # equal tables leave equal files
        from matplotlib.backends.backend_svg import FigureCanvasSVG
        from matplotlib.figure import Figure
    except ImportError as error:
        print(error.name, file=sys.stderr)
        return 3
    header, rows = read_table(directory / "sweep.csv")
    figure = Figure(figsize=(6.4, 4.4))
    canvas = FigureCanvasSVG(figure)
    axes = figure.add_subplot()
    curves = error_curves(header, rows)
    if curves:
        for label, points in curves:
            axes.loglog(*zip(*points), marker="o", markersize=4, linewidth=1.2, label=label)
        axes.set_xlabel("nodes")
        axes.set_ylabel("relative error (l2)")
    else:
        parameter = header[header.index("status") - 1]
        found = series(header, rows, parameter, "strain energy [J]", header[: header.index("status") - 1])
        for label, points in found.items():
            axes.plot(*zip(*sorted(points)), marker="o", markersize=4, linewidth=1.2, label=label or "strain energy")
        if not found:
            # The parameter has no numbers: its values stand side by side.
            energies = [(row[header.index("status") - 1], number(row[header.index("strain energy [J]")])) for row in rows]
            energies = [(name, energy) for name, energy in energies if energy is not None]
            if not energies:
                print("no run of the sweep has figures", file=sys.stderr)
                return 4
            axes.bar([name for name, _ in energies], [energy for _, energy in energies], label="strain energy")
        axes.set_xlabel(parameter)
        axes.set_ylabel("strain energy [J]")
    axes.grid(which="both", linewidth=0.4, color="0.88")
    axes.legend(fontsize=8, frameon=False)
    figure.tight_layout()
    canvas.print_svg(str(directory / "sweep.svg"), metadata={"Date": None})
    print("sweep.svg")
    return 0


if __name__ == "__main__":
    sys.exit(main())
