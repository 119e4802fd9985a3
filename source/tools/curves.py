# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws the curves of a run from its history, as SVG: loads over displacements, energies over time, cracks."""

import re

import numpy
from matplotlib import rcParams
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

# Equal runs leave equal files; text stays text.
rcParams["svg.hashsalt"] = "perideal"
rcParams["svg.fonttype"] = "none"

COLUMN = re.compile(r"(?P<what>.+?) of (?P<name>.+?)(?: along (?P<axis>[xyz]))? \[(?P<unit>.*)\]$")


def changes(values):
    """Whether there is a curve: two numbers that differ."""
    finite = values[numpy.isfinite(values)]
    return finite.size > 1 and finite.max() - finite.min() > 1e-9 * max(abs(finite.max()), abs(finite.min()))


def named_columns(history, what):
    """{(name, axis or None): values} of the columns 'WHAT of NAME along AXIS [...]'."""
    found = ((COLUMN.match(column), values) for column, values in history.items())
    return {(match["name"], match["axis"]): values for match, values in found if match and match["what"] == what}


def load_curves(history):
    """[(label, abscissa, ordinate)] and the label of the abscissa, of reactions over what moves."""
    reactions = {key: values for key, values in named_columns(history, "reaction").items() if changes(values)}
    moved = {key: values for key, values in named_columns(history, "displacement").items() if changes(values)}
    curves = [(f"{name}, {axis}", moved[name, axis], values) for (name, axis), values in reactions.items() if (name, axis) in moved]
    return curves


def gauge_curves(history):
    """[(label, abscissa, ordinate)] of the largest reaction over the elongation of each gauge."""
    reactions = {key: values for key, values in named_columns(history, "reaction").items() if changes(values)}
    gauges = {name: values for (name, _), values in named_columns(history, "elongation").items() if changes(values)}
    if not reactions or not gauges:
        return []
    (name, axis), largest = max(reactions.items(), key=lambda item: numpy.nanmax(numpy.abs(item[1])))
    return [(f"reaction of {name}, {axis}, over gauge {gauge}", values, largest) for gauge, values in gauges.items()]


def energy_curves(history, clock):
    names = [column for column in history if column.endswith("energy [J]") or column == "external work [J]"]
    return [(name[: -len(" [J]")], history[clock], history[name]) for name in names if numpy.any(history[name] != 0)]


def crack_curves(history, clock):
    names = [column for column in history if column.startswith("reach of ")]
    return [(name[: -len(" [m]")], history[clock], history[name]) for name in names if changes(history[name])]


def broken_curves(history, clock):
    values = history.get("broken bonds")
    return [("broken bonds", history[clock], values)] if values is not None and changes(values) else []


def draw(path, curves, abscissa, ordinate):
    figure = Figure(figsize=(6.4, 4.2))
    canvas = FigureCanvasSVG(figure)
    axes = figure.add_subplot()
    n_points = max(len(x) for _, x, _ in curves)
    for label, x, y in curves:
        axes.plot(x, y, label=label, linewidth=1.2, marker="o" if n_points <= 60 else None, markersize=3)
    axes.set_xlabel(abscissa)
    axes.set_ylabel(ordinate)
    axes.ticklabel_format(style="sci", scilimits=(-3, 4))
    axes.grid(linewidth=0.4, color="0.85")
    axes.legend(fontsize=8, frameon=False)
    figure.tight_layout()
    canvas.print_svg(str(path), metadata={"Date": None})


def write_curves(directory, history):
    """Writes the curves that a history gives; returns [(file name, what it shows)]."""
    if not history or len(next(iter(history.values()))) < 2:
        return []
    clock = "time [s]" if changes(history.get("time [s]", numpy.zeros(1))) else "step"
    wanted = [("curve_load.svg", "Load over displacement", load_curves(history), "displacement [m]", "reaction [N]"),
              ("curve_gauge.svg", "Load over elongation", gauge_curves(history), "elongation [m]", "reaction [N]"),
              ("curve_energy.svg", "Energies", energy_curves(history, clock), clock, "energy [J]"),
              ("curve_crack.svg", "Length of cracks", crack_curves(history, clock), clock, "reach of the tip [m]"),
              ("curve_broken_bonds.svg", "Broken bonds", broken_curves(history, clock), clock, "broken bonds")]
    written = []
    for name, title, curves, abscissa, ordinate in wanted:
        if curves:
            draw(directory / name, curves, abscissa, ordinate)
            written.append((name, title))
    return written
